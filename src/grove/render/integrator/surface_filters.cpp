#include "grove/render/integrator/surface_filters.h"

#include <algorithm>
#include <tuple>

#include "grove/render/integrator/dimensions.h"
#include "grove/render/material/opacity.h"

namespace grove {
namespace {

// In [0, 1]; 1 where no light can pass.
float opacity_at(const PreparedScene& world, const Hit& hit) {
  const std::uint32_t material = world.surfaces.material_of(hit);
  if (!world.materials.can_pass_light(material)) return 1.0F;
  return opacity(world.scene, world.scene.materials[material], world.surfaces.coordinates_at(hit));
}

// By ray, the nearest first. Where a ray meets a primitive twice, the distances tell.
auto order(std::size_t ray, const Hit& hit) {
  return std::tuple(ray, hit.t, hit.instance, hit.geometry, hit.primitive);
}

bool is_same_surface(const Hit& a, const Hit& b) {
  return a.t == b.t && a.instance == b.instance && a.geometry == b.geometry;
}

}  // namespace

bool ChanceFilter::stops(const Hit& hit) const {
  const float stopped = opacity_at(*world_, hit);
  if (stopped >= 1.0F || !(stopped > 0.0F)) return stopped >= 1.0F;
  const bool is_outside = glm::dot(ray_->direction, world_->surfaces.at(*ray_, hit).geometric_normal) < 0.0F;
  return sampler_->sample_1d(opacity_dimension(vertex_, hit, is_outside)) < stopped;
}

void LightFilter::start(std::span<const Ray> rays) {
  rays_ = rays;
  veils_.clear();
}

bool LightFilter::stops(std::size_t ray, const Hit& hit) {
  const float stopped = opacity_at(*world_, hit);
  if (stopped >= 1.0F) return true;
  if (stopped > 0.0F) veils_.push_back({ray, hit, 1.0F - stopped});
  return false;
}

void LightFilter::find_transmittances(std::span<const std::uint8_t> occluded, std::span<float> transmittances) {
  for (std::size_t i = 0; i < occluded.size(); ++i) transmittances[i] = occluded[i] != 0 ? 0.0F : 1.0F;
  std::erase_if(veils_, [&](const Veil& veil) { return occluded[veil.ray] != 0; });
  std::ranges::sort(veils_, {}, [](const Veil& veil) { return order(veil.ray, veil.hit); });
  for (std::size_t i = 0; i < veils_.size(); ++i) {
    // Triangles of one surface that share the edge or corner that the ray passes through are met at once, and count once.
    const bool is_new = i == 0 || veils_[i].ray != veils_[i - 1].ray || !is_same_surface(veils_[i].hit, veils_[i - 1].hit);
    if (is_new) transmittances[veils_[i].ray] *= veils_[i].transmittance;
  }
}

}  // namespace grove
