#include "grove/render/integrator/ray_batch.h"

#include "grove/base/timer.h"

namespace grove {

void RayBatch::find_surfaces(std::span<const Ray> rays, std::span<Hit> hits, std::span<const PathState> paths, std::uint32_t vertex) {
  rays_traced_ += rays.size();
  const Timer timer;
  if (world_->materials.any_can_pass_light()) {
    BatchChanceFilter chance(*world_, paths, vertex, rays);
    world_->accelerator.intersect(rays, hits, chance.filter());
  } else {
    world_->accelerator.intersect(rays, hits);
  }
  trace_seconds_ += timer.seconds();
}

void RayBatch::find_light(std::span<const Ray> rays, std::span<float> transmittances) {
  rays_traced_ += rays.size();
  occluded_.resize(rays.size());
  const Timer timer;
  light_.start(rays);
  if (world_->materials.any_can_pass_light()) {
    world_->accelerator.occluded(rays, occluded_, light_.filter());
  } else {
    world_->accelerator.occluded(rays, occluded_);
  }
  light_.find_transmittances(occluded_, transmittances);
  trace_seconds_ += timer.seconds();
}

}  // namespace grove
