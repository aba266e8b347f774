#include "grove/render/integrator/ray_batch.h"

#include "grove/base/timer.h"

namespace grove {

void RayBatch::closest_hits(std::span<const Ray> rays, std::span<Hit> hits) {
  rays_traced_ += rays.size();
  const Timer timer;
  world_->accelerator.intersect(rays, hits);
  trace_seconds_ += timer.seconds();
}

void RayBatch::find_surfaces(std::span<const Ray> rays, std::span<Hit> hits, std::span<const PathState> paths, std::uint32_t vertex) {
  closest_hits(rays, hits);
  if (!world_->materials.any_can_pass_light()) return;
  const Timer timer;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!hits[i]) continue;
    ChanceFilter chance(*world_, paths[i].sampler, vertex, rays[i]);
    if (!chance.stops(hits[i])) hits[i] = world_->accelerator.closest_hit(from_hit_on(rays[i], hits[i]), chance.filter());
  }
  trace_seconds_ += timer.seconds();
}

void RayBatch::any_hits(std::span<const Ray> rays, std::span<float> transmittances) {
  rays_traced_ += rays.size();
  occluded_.resize(rays.size());
  const Timer timer;
  world_->accelerator.occluded(rays, occluded_);
  trace_seconds_ += timer.seconds();
  for (std::size_t i = 0; i < rays.size(); ++i) transmittances[i] = occluded_[i] != 0 ? 0.0F : 1.0F;
}

void RayBatch::find_light(std::span<const Ray> rays, std::span<float> transmittances) {
  if (!world_->materials.any_can_pass_light()) {
    any_hits(rays, transmittances);
    return;
  }
  nearest_.resize(rays.size());
  closest_hits(rays, nearest_);
  const Timer timer;
  for (std::size_t i = 0; i < rays.size(); ++i) transmittances[i] = transmittance_behind(*world_, rays[i], nearest_[i], light_);
  trace_seconds_ += timer.seconds();
}

}  // namespace grove
