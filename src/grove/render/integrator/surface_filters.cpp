#include "grove/render/integrator/surface_filters.h"

#include <algorithm>
#include <tuple>

#include "grove/render/integrator/dimensions.h"
#include "grove/render/material/opacity.h"

namespace grove {
namespace {

bool can_pass(const PreparedScene& world, const Hit& hit) {
  return world.materials.can_pass_light(world.surfaces.material_of(hit));
}

float opacity_at(const PreparedScene& world, const SurfacePoint& point) {
  return opacity(world.scene, world.scene.materials[point.material], point);
}

// The nearest first. Where a ray meets a primitive twice, the distances tell.
auto order(const Hit& hit) {
  return std::tuple(hit.t, hit.instance, hit.geometry, hit.primitive);
}

bool is_same_surface(const Hit& a, const Hit& b) {
  return a.t == b.t && a.instance == b.instance && a.geometry == b.geometry;
}

}  // namespace

bool ChanceFilter::stops(const Hit& hit) const {
  if (!can_pass(*world_, hit)) return true;
  const SurfacePoint point = world_->surfaces.at(*ray_, hit);
  const float stopped = opacity_at(*world_, point);
  if (stopped >= 1.0F || !(stopped > 0.0F)) return stopped >= 1.0F;
  const bool is_outside = glm::dot(ray_->direction, point.geometric_normal) < 0.0F;
  return sampler_->sample_1d(opacity_dimension(vertex_, hit, is_outside)) < stopped;
}

void LightFilter::start(const Ray& ray) {
  ray_ = &ray;
  veils_.clear();
}

bool LightFilter::stops(const Hit& hit) {
  if (!can_pass(*world_, hit)) return true;
  const float stopped = opacity_at(*world_, world_->surfaces.at(*ray_, hit));
  if (stopped >= 1.0F) return true;
  if (stopped > 0.0F) veils_.push_back({hit, 1.0F - stopped});
  return false;
}

float LightFilter::transmittance() {
  std::ranges::sort(veils_, {}, [](const Veil& veil) { return order(veil.hit); });
  float passed = 1.0F;
  for (std::size_t i = 0; i < veils_.size(); ++i) {
    // Triangles of one surface that share the edge or corner that the ray passes through are met at once, and count once.
    if (i == 0 || !is_same_surface(veils_[i].hit, veils_[i - 1].hit)) passed *= veils_[i].transmittance;
  }
  return passed;
}

float transmittance_behind(const PreparedScene& world, const Ray& ray, const Hit& nearest, LightFilter& light) {
  if (!nearest) return 1.0F;
  light.start(ray);
  if (light.stops(nearest) || world.accelerator.any_hit(from_hit_on(ray, nearest), light.filter())) return 0.0F;
  return light.transmittance();
}

}  // namespace grove
