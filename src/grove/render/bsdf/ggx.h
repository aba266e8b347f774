#pragma once

#include <algorithm>
#include <cmath>

#include "grove/math/vector.h"

// The GGX distribution of microfacet normals (Trowbridge and Reitz 1975; Walter, Marschner, Li, Torrance 2007, "Microfacet Models for
// Refraction through Rough Surfaces") with the height-correlated shadowing of Heitz 2014, "Understanding the Masking-Shadowing Function
// in Microfacet-Based BRDFs". Isotropic; `alpha` is the width.

namespace grove {

/// Density of facet normals per facet solid angle and surface area.
[[nodiscard]] inline float ggx_distribution(const Vec3& m, float alpha) {
  if (m.z <= 0.0F) return 0.0F;
  // cos^4 (tan^2 + a^2)^2 pi / a^2, with cos^2 (tan^2 + a^2) = sin^2 + a^2 cos^2; the sine from x and y, to be exact near the pole.
  const float a2 = alpha * alpha;
  const float d = m.x * m.x + m.y * m.y + a2 * m.z * m.z;
  return a2 / (kPi * d * d);
}

/// Smith's Lambda (Heitz 2014, eq. 72).
[[nodiscard]] inline float ggx_lambda(const Vec3& w, float alpha) {
  const float z2 = w.z * w.z;
  if (z2 <= 0.0F) return INFINITY;
  const float tan2 = (w.x * w.x + w.y * w.y) / z2;
  return 0.5F * (std::sqrt(1.0F + alpha * alpha * tan2) - 1.0F);
}

/// The part of the facets that is seen from `w`.
[[nodiscard]] inline float ggx_masking(const Vec3& w, float alpha) {
  return 1.0F / (1.0F + ggx_lambda(w, alpha));
}

/// The part seen from both directions (Heitz 2014, eq. 99), over the part seen from `wo`.
[[nodiscard]] inline float ggx_shadowing_over_masking(const Vec3& wo, const Vec3& wi, float alpha) {
  const float lambda_o = ggx_lambda(wo, alpha);
  return (1.0F + lambda_o) / (1.0F + lambda_o + ggx_lambda(wi, alpha));
}

/// Density of `sample_ggx_visible_normal` per solid angle of m; wo.z > 0.
[[nodiscard]] inline float ggx_visible_density(const Vec3& wo, const Vec3& m, float alpha) {
  return ggx_masking(wo, alpha) * ggx_distribution(m, alpha) * std::max(0.0F, glm::dot(wo, m)) / wo.z;
}

/// A facet normal in proportion to how much of it is seen from `wo` (Heitz 2018, "Sampling the GGX Distribution of Visible Normals"),
/// by the cap of the sphere of reflected directions (Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps").
[[nodiscard]] inline Vec3 sample_ggx_visible_normal(const Vec3& wo, float alpha, const Vec2& u) {
  // To the configuration where the surface is a hemisphere.
  const Vec3 v = glm::normalize(Vec3(alpha * wo.x, alpha * wo.y, wo.z));
  const float phi = 2.0F * kPi * u.x;
  const float z = (1.0F - u.y) * (1.0F + v.z) - v.z;
  const float r = std::sqrt(std::clamp(1.0F - z * z, 0.0F, 1.0F));
  const Vec3 reflected(r * std::cos(phi), r * std::sin(phi), z);
  const Vec3 h = reflected + v;
  // And back.
  return glm::normalize(Vec3(alpha * h.x, alpha * h.y, std::max(1e-7F, h.z)));
}

}  // namespace grove
