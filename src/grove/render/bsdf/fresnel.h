#pragma once

#include "grove/math/vector.h"

namespace grove {

/// The reflected part of unpolarised light at a smooth boundary. `cosine` in [0, 1] is that of the angle to the normal; `eta` is the
/// index on the far side over that on the near side. 1 beyond the critical angle.
[[nodiscard]] float fresnel_dielectric(float cosine, float eta);

/// The same for a metal, per colour channel, with complex index eta + i k relative to the near side.
[[nodiscard]] Vec3 fresnel_conductor(float cosine, const Vec3& eta, const Vec3& k);

/// (1 - cosine)^5, by which Schlick (1994, "An Inexpensive BRDF Model for Physically-based Rendering", eq. 15) goes from the
/// reflectance at normal incidence to 1.
[[nodiscard]] inline float schlick_weight(float cosine) {
  const float m = cosine < 1.0F ? 1.0F - cosine : 0.0F;
  const float m2 = m * m;
  return m2 * m2 * m;
}

[[nodiscard]] inline Vec3 fresnel_schlick(float cosine, const Vec3& f0) {
  return f0 + (Vec3(1.0F) - f0) * schlick_weight(cosine);
}

/// The mirror image of `wo` about `m`.
[[nodiscard]] inline Vec3 reflect_about(const Vec3& wo, const Vec3& m) {
  return 2.0F * glm::dot(wo, m) * m - wo;
}

/// Where light from the far side of a boundary with normal `m` (on the side of `wo`) leaves towards `wo`; false on total reflection.
[[nodiscard]] bool refract_about(const Vec3& wo, const Vec3& m, float eta, Vec3& wi);

}  // namespace grove
