#pragma once

#include <algorithm>
#include <cmath>

#include "grove/math/vector.h"

// Maps from the unit square to the domains that a renderer samples. Each keeps strata together.

namespace grove {

/// Uniform on the unit disk (Shirley and Chiu 1997, "A Low Distortion Map Between Disk and Square").
[[nodiscard]] inline Vec2 sample_disk(const Vec2& u) {
  const Vec2 p = 2.0F * u - Vec2(1.0F);
  if (p.x == 0.0F && p.y == 0.0F) return Vec2(0.0F);
  if (std::fabs(p.x) > std::fabs(p.y)) {
    const float angle = 0.25F * kPi * (p.y / p.x);
    return p.x * Vec2(std::cos(angle), std::sin(angle));
  }
  const float angle = 0.5F * kPi - 0.25F * kPi * (p.x / p.y);
  return p.y * Vec2(std::cos(angle), std::sin(angle));
}

/// Cosine-weighted on the hemisphere around +z; the density is cos / pi.
[[nodiscard]] inline Vec3 sample_cosine_hemisphere(const Vec2& u) {
  const Vec2 d = sample_disk(u);
  return {d.x, d.y, std::sqrt(std::max(0.0F, 1.0F - d.x * d.x - d.y * d.y))};
}

/// Uniform on the unit sphere; the density is 1 / (4 pi).
[[nodiscard]] inline Vec3 sample_sphere(const Vec2& u) {
  const float z = 1.0F - 2.0F * u.x;
  const float r = std::sqrt(std::max(0.0F, 1.0F - z * z));
  const float phi = 2.0F * kPi * u.y;
  return {r * std::cos(phi), r * std::sin(phi), z};
}

/// Uniform barycentrics (u, v) of a triangle (Heitz 2019, "A Low-Distortion Map Between Triangle and Square").
[[nodiscard]] inline Vec2 sample_triangle(const Vec2& u) {
  if (u.y > u.x) {
    const float a = 0.5F * u.x;
    return {a, u.y - a};
  }
  const float b = 0.5F * u.y;
  return {u.x - b, b};
}

/// An offset in (-1, 1) with the density of the tent filter 1 - |x|.
[[nodiscard]] inline float sample_tent(float u) {
  return u < 0.5F ? std::sqrt(2.0F * u) - 1.0F : 1.0F - std::sqrt(2.0F - 2.0F * u);
}

/// Weight of a sample of density `taken` when another technique of density `other` could have made it, both with one sample: the
/// power heuristic with exponent 2 (Veach and Guibas 1995, "Optimally Combining Sampling Techniques", eq. 15).
[[nodiscard]] inline float power_heuristic(float taken, float other) {
  if (!(taken > 0.0F)) return 0.0F;
  // By the ratio, because the squares of densities of small lights overflow.
  const float ratio = other / taken;
  return 1.0F / (1.0F + ratio * ratio);
}

}  // namespace grove
