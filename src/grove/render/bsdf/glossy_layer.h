#pragma once

#include <algorithm>

#include "grove/render/bsdf/albedo_tables.h"
#include "grove/render/bsdf/conductor.h"

namespace grove {

/// A GGX mirror as glTF 2.0 has it (appendix B): reflectance by Schlick from `f0` at normal incidence to `f90` at grazing, with
/// compensation for multiple scattering.
struct GlossyLayer {
  Vec3 f0{0.04F};
  float f90 = 1.0F;
  float alpha = 0.0F;

  [[nodiscard]] bool is_smooth() const { return alpha < kSmoothAlpha; }

  [[nodiscard]] Vec3 fresnel(float cosine) const { return f0 + (Vec3(f90) - f0) * schlick_weight(cosine); }

  /// All that is reflected of light from the direction with this cosine.
  [[nodiscard]] Vec3 albedo(float cosine) const {
    if (is_smooth()) return fresnel(cosine);
    const GgxAlbedo::Single lossless = ggx_albedo().single(cosine, alpha);
    const Vec3 single = f0 * lossless.scale + Vec3(f90 * lossless.bias);
    return glm::min(single * multiple_scattering_gain(lossless, f0), Vec3(1.0F));
  }

  /// Value and density of the lobe; zeros when smooth.
  [[nodiscard]] BsdfValue evaluate(const Vec3& wo, const Vec3& wi) const {
    if (is_smooth()) return {};
    const MirrorPair pair = mirror_pair(wo, wi, alpha);
    if (!(pair.density > 0.0F)) return {};
    return {fresnel(pair.facet_cosine) * multiple_scattering_gain(wo.z, alpha, f0) * (pair.density * pair.shadowing), pair.density};
  }
};

}  // namespace grove
