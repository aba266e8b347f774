#include "grove/render/integrator/ray_tracer.h"

namespace grove {

void RayTracer::count(const Ray& ray, bool asks_any) {
  ++rays_traced_;
  if (recording_ != nullptr) recording_->push_back({ray, surfaces_, asks_any});
}

bool RayTracer::find_surface(const Ray& ray, SurfaceHit& result) {
  count(ray, false);
  const std::uint32_t vertex = surfaces_++;
  result.ray = ray;
  if (world_->materials.any_can_pass_light()) {
    ChanceFilter chance(*world_, *sampler_, vertex, ray);
    result.hit = world_->accelerator.closest_hit(ray, chance.filter());
  } else {
    result.hit = world_->accelerator.closest_hit(ray, nullptr);
  }
  if (!result.hit) return false;
  result.point = world_->surfaces.at(ray, result.hit);
  return true;
}

float RayTracer::transmittance(const Ray& ray) {
  count(ray, true);
  if (!world_->materials.any_can_pass_light()) return world_->accelerator.any_hit(ray, nullptr) ? 0.0F : 1.0F;
  light_.start({&ray, 1});
  const std::uint8_t occluded = world_->accelerator.any_hit(ray, light_.filter_of_first()) ? 1 : 0;
  float result = 0.0F;
  light_.find_transmittances({&occluded, 1}, {&result, 1});
  return result;
}

}  // namespace grove
