#include "grove/render/integrator/ray_tracer.h"

#include "grove/render/integrator/light_passage.h"

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
  const std::uint32_t bounce = surfaces_++;
  result.ray = ray;
  for (int passage = 0; passage < kMostPassages; ++passage) {
    result.hit = closest_hit(result.ray, bounce);
    if (!result.hit) return false;
    if (!stops_ray(*world_, result.hit, *sampler_, chances_taken_, result.ray)) continue;
    result.point = world_->surfaces.at(result.ray, result.hit);
    return true;
  }
  return false;
}

float RayTracer::transmittance(Ray ray) {
  if (!world_->materials.any_can_pass_light()) return any_hit(ray) ? 0.0F : 1.0F;
  LightPassage light(ray);
  for (int passage = 0; passage < kMostPassages; ++passage) {
    if (!light.pass(*world_, closest_hit(ray, surfaces_), ray)) return light.transmittance();
  }
  return 0.0F;
}

}  // namespace grove
