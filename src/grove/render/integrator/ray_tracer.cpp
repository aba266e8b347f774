#include "grove/render/integrator/ray_tracer.h"

#include "grove/render/integrator/dimensions.h"
#include "grove/render/material/opacity.h"

namespace grove {
namespace {

// Transparent surfaces along one ray. A thick tree has some hundred; more means that coordinates are too coarse to get on.
constexpr int kMaxPasses = 1024;

}  // namespace

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
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    result.hit = closest_hit(result.ray, bounce);
    if (!result.hit) return false;
    result.point = world_->surfaces.at(result.ray, result.hit);
    if (!world_->materials.can_pass_light(result.point.material)) return true;
    const float stopped = opacity(world_->scene, world_->scene.materials[result.point.material], result.point);
    if (stopped >= 1.0F) return true;
    if (stopped > 0.0F && sampler_->sample_1d(kFirstOpacityDimension + chances_taken_++) < stopped) return true;
    result.ray.origin = result.point.offset_origin(result.ray.direction);
    result.ray.t_min = 0.0F;
    if (ray.t_max < std::numeric_limits<float>::infinity()) result.ray.t_max -= result.hit.t;
  }
  return false;
}

float RayTracer::transmittance(const SurfacePoint& point, const LightSample& sample) {
  Ray ray;
  ray.origin = point.offset_origin(sample.direction);
  ray.direction = sample.direction;
  if (!sample.is_infinite) {
    // Both ends are moved off their surfaces, so that the whole segment counts.
    ray.direction = sample.target - ray.origin;
    ray.t_max = 1.0F;
  }
  return transmittance(ray);
}

float RayTracer::transmittance(Ray ray) {
  if (!world_->materials.any_can_pass_light()) return any_hit(ray) ? 0.0F : 1.0F;
  const bool is_finite = ray.t_max < std::numeric_limits<float>::infinity();
  const Vec3 end = is_finite ? ray.at(ray.t_max) : Vec3(0.0F);
  float passed = 1.0F;
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    const Hit hit = closest_hit(ray, surfaces_);
    if (!hit) return passed;
    if (!world_->materials.can_pass_light(world_->surfaces.material_of(hit))) return 0.0F;
    const SurfacePoint point = world_->surfaces.at(ray, hit);
    passed *= 1.0F - opacity(world_->scene, world_->scene.materials[point.material], point);
    if (!(passed > 0.0F)) return 0.0F;
    ray.origin = point.offset_origin(ray.direction);
    ray.t_min = 0.0F;
    if (!is_finite) continue;
    const Vec3 rest = end - ray.origin;
    if (!(glm::dot(rest, ray.direction) > 0.0F)) return passed;
    ray.direction = rest;
    ray.t_max = 1.0F;
  }
  return 0.0F;
}

}  // namespace grove
