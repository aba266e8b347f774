#pragma once

#include "grove/render/bsdf/albedo_tables.h"
#include "grove/render/bsdf/microfacet_lobe.h"

namespace grove {

/// How a metal reflects per angle: by complex index of refraction, or by Schlick from the reflectance at normal incidence.
struct MetalFresnel {
  bool has_complex_ior = false;
  Vec3 eta{1.0F};
  Vec3 k{0.0F};
  Vec3 f0{1.0F};

  [[nodiscard]] Vec3 operator()(float cosine) const {
    return has_complex_ior ? fresnel_conductor(cosine, eta, k) : fresnel_schlick(cosine, f0);
  }
};

/// What light that bounces between facets adds to a rough mirror: the single-scattering value is multiplied by
/// 1 + F0 (1 - E) / E, with E the albedo of a lossless mirror (Turquin 2019, "Practical Multiple Scattering Compensation for Microfacet
/// Models", eq. 16). A lossless mirror then loses nothing. It depends on wo alone, so it breaks reciprocity slightly.
[[nodiscard]] inline Vec3 multiple_scattering_gain(const GgxAlbedo::Single& lossless, const Vec3& f0) {
  const float single = lossless.scale + lossless.bias;
  return Vec3(1.0F) + f0 * ((1.0F - single) / single);
}

[[nodiscard]] inline Vec3 multiple_scattering_gain(float cosine, float alpha, const Vec3& f0) {
  return multiple_scattering_gain(ggx_albedo().single(cosine, alpha), f0);
}

/// A metal with a GGX surface.
struct ConductorBsdf {
  MetalFresnel fresnel;
  float alpha = 0.0F;

  [[nodiscard]] BsdfValue evaluate(const Vec3& wo, const Vec3& wi) const {
    if (is_delta()) return {};
    const MirrorPair pair = mirror_pair(wo, wi, alpha);
    if (!(pair.density > 0.0F)) return {};
    return {pair.density * weight(wo, pair), pair.density};
  }

  [[nodiscard]] BsdfSample sample(const Vec3& wo, float /*u_lobe*/, const Vec2& u) const {
    const Vec3 wi = sample_mirror(wo, alpha, u);
    if (is_delta()) return {.wi = wi, .weight = fresnel(wo.z), .pdf = 1.0F, .is_delta = true};
    const MirrorPair pair = mirror_pair(wo, wi, alpha);
    if (!(pair.density > 0.0F)) return {};
    return {.wi = wi, .weight = weight(wo, pair), .pdf = pair.density};
  }

  [[nodiscard]] Vec3 albedo(const Vec3& wo) const { return fresnel(wo.z); }
  [[nodiscard]] bool is_delta() const { return alpha < kSmoothAlpha; }

 private:
  [[nodiscard]] Vec3 weight(const Vec3& wo, const MirrorPair& pair) const {
    return fresnel(pair.facet_cosine) * pair.shadowing * multiple_scattering_gain(wo.z, alpha, fresnel(1.0F));
  }
};

}  // namespace grove
