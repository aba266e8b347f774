#pragma once

#include <cstdint>
#include <vector>

#include "grove/render/integrator/recorded_ray.h"
#include "grove/render/scene_accelerator.h"
#include "grove/scene/scene.h"

namespace grove {

struct RecordSettings {
  std::uint32_t width = 1;      ///< pixels, at least 1
  std::uint32_t height = 1;     ///< pixels, at least 1
  std::uint32_t max_depth = 8;  ///< as RenderSettings::max_depth
  std::uint64_t seed = 0;
};

/// Every ray that path-tracing a picture with one sample a pixel asks the structure about, path by path, row by row: exactly those of `render` with the
/// same camera, size, depth and seed. The same rays for any structure and number of threads. Parallel in the caller's oneTBB arena.
[[nodiscard]] std::vector<RecordedRay> record_rays(const Scene& scene, const SceneAccelerator& accelerator, const Camera& camera,
                                                   const RecordSettings& settings);

}  // namespace grove
