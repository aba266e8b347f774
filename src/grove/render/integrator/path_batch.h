#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "grove/render/film.h"
#include "grove/render/integrator/path_vertex.h"
#include "grove/render/integrator/ray_batch.h"

namespace grove {

/// Traces many paths together, vertex by vertex: all rays to the next surfaces in one call of the structure, all rays to lights in another (Laine, Karras,
/// Aila 2013, "Megakernels Considered Harmful: Wavefront Path Tracing on GPUs"; here for the sake of structures that keep many rays in flight). For one
/// thread; it keeps its memory from call to call: 133 bytes for each path of the largest batch.
class PathBatch {
 public:
  PathBatch(const PreparedScene& world, const PathSettings& settings) : world_(&world), settings_(settings), tracer_(world) {}

  /// samples[i] becomes what trace_path finds along camera_rays[i] with samplers[i], bit for bit; the rays are lost. The spans must be of equal
  /// length, below 2^32.
  void trace(std::span<Ray> camera_rays, std::span<const Sampler> samplers, std::span<Film::Sample> samples);

  /// Over all calls.
  [[nodiscard]] std::uint64_t rays_traced() const { return tracer_.rays_traced(); }

 private:
  struct Light {
    Vec3 radiance;
    std::uint32_t path;
  };

  // Leaves the paths that go on, and their rays, in the first places, in the same order; returns how many.
  std::size_t shade(std::uint32_t vertex, std::span<Ray> rays, std::span<Film::Sample> samples);

  const PreparedScene* world_;
  PathSettings settings_;
  RayBatch tracer_;
  std::vector<PathState> paths_;
  std::vector<Hit> hits_;
  std::vector<Ray> shadow_rays_;
  std::vector<Light> light_;
  std::vector<float> transmittances_;
};

}  // namespace grove
