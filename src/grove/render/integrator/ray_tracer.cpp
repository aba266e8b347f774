#include "grove/render/integrator/ray_tracer.h"

namespace grove {

Hit RayTracer::closest_hit(const Ray& ray, std::uint32_t bounce) {
  ++rays_traced_;
  if (recording_ != nullptr) recording_->push_back({ray, bounce, false});
  return world_->accelerator.closest_hit(ray, nullptr);
}

bool RayTracer::any_hit(const Ray& ray) {
  ++rays_traced_;
  if (recording_ != nullptr) recording_->push_back({ray, surfaces_, true});
  return world_->accelerator.any_hit(ray, nullptr);
}

bool RayTracer::find_surface(const Ray& ray, SurfaceHit& result) {
  const std::uint32_t vertex = surfaces_++;
  result.ray = ray;
  result.hit = closest_hit(ray, vertex);
  if (result.hit && world_->materials.any_can_pass_light()) {
    ChanceFilter chance(*world_, *sampler_, vertex, ray);
    if (!chance.stops(result.hit)) result.hit = world_->accelerator.closest_hit(from_hit_on(ray, result.hit), chance.filter());
  }
  if (!result.hit) return false;
  result.point = world_->surfaces.at(ray, result.hit);
  return true;
}

float RayTracer::transmittance(const Ray& ray) {
  if (!world_->materials.any_can_pass_light()) return any_hit(ray) ? 0.0F : 1.0F;
  return transmittance_behind(*world_, ray, closest_hit(ray, surfaces_), light_);
}

}  // namespace grove
