#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "grove/render/integrator/path_vertex.h"
#include "grove/render/integrator/surface_filters.h"

namespace grove {

/// Traces rays of many paths together, through what lets light pass (alpha, interfaces), and counts them. It finds what RayTracer finds. For one thread; it
/// keeps its memory from call to call.
class RayBatch {
 public:
  explicit RayBatch(const PreparedScene& world) : world_(&world), light_(world) {}

  /// hits[i] becomes the first surface along rays[i] that stops it; a partly transparent one does by the chances of paths[i], which `vertex` surfaces have
  /// scattered before. The spans must be of equal length.
  void find_surfaces(std::span<const Ray> rays, std::span<Hit> hits, std::span<const PathState> paths, std::uint32_t vertex);

  /// transmittances[i] becomes the part of light, in [0, 1], that comes along rays[i], finite or infinite. The spans must be of equal length.
  void find_light(std::span<const Ray> rays, std::span<float> transmittances);

  [[nodiscard]] std::uint64_t rays_traced() const { return rays_traced_; }
  /// Seconds within the structure, and in deciding what lets light pass.
  [[nodiscard]] double trace_seconds() const { return trace_seconds_; }

 private:
  const PreparedScene* world_;
  std::uint64_t rays_traced_ = 0;
  double trace_seconds_ = 0.0;
  LightFilter light_;
  std::vector<std::uint8_t> occluded_;
};

}  // namespace grove
