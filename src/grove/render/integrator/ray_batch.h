#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "grove/render/integrator/light_passage.h"
#include "grove/render/integrator/path_vertex.h"

namespace grove {

/// Traces rays of many paths together, through what lets light pass (alpha, interfaces), and counts them. It finds what RayTracer finds. For one thread; it
/// keeps its memory from call to call.
class RayBatch {
 public:
  explicit RayBatch(const PreparedScene& world) : world_(&world) {}

  /// hits[i] becomes the first surface along rays[i] that stops it; a partly transparent one does by the chances of paths[i]. The rays become the last
  /// pieces, after passing through surfaces. The spans must be of equal length.
  void find_surfaces(std::span<Ray> rays, std::span<Hit> hits, std::span<PathState> paths);

  /// transmittances[i] becomes the part of light, in [0, 1], that comes along rays[i], finite or infinite; the rays are lost. The spans must be of
  /// equal length.
  void find_light(std::span<Ray> rays, std::span<float> transmittances);

  [[nodiscard]] std::uint64_t rays_traced() const { return rays_traced_; }

 private:
  // Rays that have passed through something and must be traced on, and which of the batch they are.
  struct Pending {
    std::vector<std::uint32_t> ids;
    std::vector<Ray> rays;
    std::vector<Hit> hits;
  };

  void closest_hits(std::span<const Ray> rays, std::span<Hit> hits);
  void any_hits(std::span<const Ray> rays, std::span<float> transmittances);

  const PreparedScene* world_;
  std::uint64_t rays_traced_ = 0;
  Pending pending_;
  std::vector<LightPassage> light_;
  std::vector<std::uint8_t> occluded_;
};

}  // namespace grove
