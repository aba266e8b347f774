#include "grove/render/integrator/ray_batch.h"

namespace grove {

void RayBatch::closest_hits(std::span<const Ray> rays, std::span<Hit> hits) {
  rays_traced_ += rays.size();
  world_->accelerator.intersect(rays, hits);
}

void RayBatch::find_surfaces(std::span<const Ray> rays, std::span<Hit> hits, std::span<const PathState> paths, std::uint32_t vertex) {
  closest_hits(rays, hits);
  if (!world_->materials.any_can_pass_light()) return;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!hits[i]) continue;
    ChanceFilter chance(*world_, paths[i].sampler, vertex, rays[i]);
    if (!chance.stops(hits[i])) hits[i] = world_->accelerator.closest_hit(from_hit_on(rays[i], hits[i]), chance.filter());
  }
}

void RayBatch::any_hits(std::span<const Ray> rays, std::span<float> transmittances) {
  rays_traced_ += rays.size();
  occluded_.resize(rays.size());
  world_->accelerator.occluded(rays, occluded_);
  for (std::size_t i = 0; i < rays.size(); ++i) transmittances[i] = occluded_[i] != 0 ? 0.0F : 1.0F;
}

void RayBatch::find_light(std::span<const Ray> rays, std::span<float> transmittances) {
  if (!world_->materials.any_can_pass_light()) {
    any_hits(rays, transmittances);
    return;
  }
  nearest_.resize(rays.size());
  closest_hits(rays, nearest_);
  for (std::size_t i = 0; i < rays.size(); ++i) transmittances[i] = transmittance_behind(*world_, rays[i], nearest_[i], light_);
}

}  // namespace grove
