#include "grove/render/integrator/light_passage.h"

#include <limits>

#include "grove/render/integrator/dimensions.h"
#include "grove/render/material/opacity.h"

namespace grove {
namespace {

bool is_finite(const Ray& ray) {
  return ray.t_max < std::numeric_limits<float>::infinity();
}

float opacity_at(const PreparedScene& world, const SurfacePoint& point) {
  return opacity(world.scene, world.scene.materials[point.material], point);
}

}  // namespace

bool stops_ray(const PreparedScene& world, const Hit& hit, const Sampler& sampler, std::uint32_t& chances_taken, Ray& ray) {
  if (!world.materials.can_pass_light(world.surfaces.material_of(hit))) return true;
  const SurfacePoint point = world.surfaces.at(ray, hit);
  const float stopped = opacity_at(world, point);
  if (stopped >= 1.0F) return true;
  if (stopped > 0.0F && sampler.sample_1d(kFirstOpacityDimension + chances_taken++) < stopped) return true;
  ray.origin = point.offset_origin(ray.direction);
  ray.t_min = 0.0F;
  if (is_finite(ray)) ray.t_max -= hit.t;
  return false;
}

LightPassage::LightPassage(const Ray& ray) : end_(is_finite(ray) ? ray.at(ray.t_max) : Vec3(0.0F)) {}

bool LightPassage::pass(const PreparedScene& world, const Hit& hit, Ray& ray) {
  if (!hit) return false;
  if (!world.materials.can_pass_light(world.surfaces.material_of(hit))) {
    passed_ = 0.0F;
    return false;
  }
  const SurfacePoint point = world.surfaces.at(ray, hit);
  passed_ *= 1.0F - opacity_at(world, point);
  if (!(passed_ > 0.0F)) {
    passed_ = 0.0F;
    return false;
  }
  ray.origin = point.offset_origin(ray.direction);
  ray.t_min = 0.0F;
  if (!is_finite(ray)) return true;
  const Vec3 rest = end_ - ray.origin;
  if (!(glm::dot(rest, ray.direction) > 0.0F)) return false;
  ray.direction = rest;
  ray.t_max = 1.0F;
  return true;
}

}  // namespace grove
