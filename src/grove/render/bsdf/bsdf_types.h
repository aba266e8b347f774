#pragma once

#include "grove/math/vector.h"

namespace grove {

// Scattering functions work in a local frame: +z is the shading normal, turned to the side of `wo`, the direction towards the viewer,
// so that wo.z > 0 always. `wi` is the direction that light comes from; wi.z > 0 is reflection, wi.z < 0 transmission. All directions
// are of unit length and point away from the surface.
//
// A model is a small value with
//   BsdfValue evaluate(wo, wi) const   the part that is not a delta function;
//   BsdfSample sample(wo, u_lobe, u) const   with u_lobe in [0, 1) to choose a lobe and u in [0, 1)^2 for the direction;
//   Vec3 albedo(wo) const   about how much light comes back, for denoisers;
//   bool is_delta() const   true when `evaluate` is zero everywhere.

/// The scattering function times |wi.z|, and the density with which `sample` chooses wi, with respect to solid angle.
struct BsdfValue {
  Vec3 value{0.0F};
  float pdf = 0.0F;
};

/// A chosen direction. No sample when `pdf` is 0.
struct BsdfSample {
  Vec3 wi{0.0F};
  Vec3 weight{0.0F};  ///< scattering function times |wi.z| over the density (for a delta: over the chance)
  float pdf = 0.0F;   ///< density with respect to solid angle; for a delta direction the chance, meaningful only as non-zero
  bool is_delta = false;
  /// (n_t / n_i)^2 where the path enters another medium, which undoes the change of radiance that refraction makes; else 1.
  float eta_squared = 1.0F;

  [[nodiscard]] explicit operator bool() const { return pdf > 0.0F; }
};

/// The chance of choosing the first of two lobes that return this much light: its share, and a tenth at least, since a fainter one that mirrors something bright
/// would show as rare bright dots. (A quarter, as it was once, made 2 to 12 % more noise in five scenes, those lit by lamps included.)
[[nodiscard]] inline float lobe_chance(float first, float second) {
  if (!(second > 0.0F)) return 1.0F;
  if (!(first > 0.0F)) return 0.0F;
  const float share = first / (first + second);
  return share < 0.1F ? 0.1F : share;
}

/// Below this width a GGX surface is treated as perfectly smooth: its lobe is narrower than what floats and samplers resolve.
inline constexpr float kSmoothAlpha = 1.001e-3F;

[[nodiscard]] inline float luminance(const Vec3& colour) {
  // Rec. 709 weights.
  return 0.2126F * colour.x + 0.7152F * colour.y + 0.0722F * colour.z;
}

[[nodiscard]] inline float max_component(const Vec3& v) {
  return v.x > v.y ? (v.x > v.z ? v.x : v.z) : (v.y > v.z ? v.y : v.z);
}

}  // namespace grove
