#pragma once

#include "grove/render/bsdf/bsdf_types.h"
#include "grove/render/bsdf/fresnel.h"
#include "grove/render/bsdf/ggx.h"

// The parts that all GGX mirrors share. A lobe is sampled by visible normals, so its value is (density) * (reflectance) *
// (shadowing over masking), and the weight of a sample is what follows the density.

namespace grove {

/// A pair of directions as a facet sees it.
struct MirrorPair {
  float facet_cosine = 0.0F;  ///< between wo and the facet's normal
  float density = 0.0F;       ///< of sampling wi, per solid angle
  float shadowing = 0.0F;     ///< over masking
};

/// Zeros unless wi is on the viewer's side.
[[nodiscard]] inline MirrorPair mirror_pair(const Vec3& wo, const Vec3& wi, float alpha) {
  if (wi.z <= 0.0F || wo.z <= 0.0F) return {};
  const Vec3 h = wo + wi;
  const float length = glm::length(h);
  if (!(length > 0.0F)) return {};
  const Vec3 m = h / length;
  const float cosine = glm::dot(wo, m);
  if (cosine <= 0.0F) return {};
  return {std::min(1.0F, cosine), ggx_visible_density(wo, m, alpha) / (4.0F * cosine), ggx_shadowing_over_masking(wo, wi, alpha)};
}

/// The mirrored direction of a sampled facet; it may lie below the surface.
[[nodiscard]] inline Vec3 sample_mirror(const Vec3& wo, float alpha, const Vec2& u) {
  if (alpha < kSmoothAlpha) return {-wo.x, -wo.y, wo.z};
  return glm::normalize(reflect_about(wo, sample_ggx_visible_normal(wo, alpha, u)));
}

}  // namespace grove
