#pragma once

#include "grove/render/bsdf/albedo_tables.h"
#include "grove/render/bsdf/glossy_layer.h"
#include "grove/render/bsdf/microfacet_lobe.h"

namespace grove {

/// What an artist makes of a boundary's reflection (KHR_materials_specular): a factor on all of it and a tint of what is reflected at normal
/// incidence. Total reflection stays total.
struct ReflectionFactors {
  float weight = 1.0F;
  Vec3 tint{1.0F};

  /// The reflectance that takes the place of `fresnel`, with `f0` that at normal incidence. The way from there to grazing angles is that of
  /// `fresnel`, where the extension has Schlick's.
  [[nodiscard]] Vec3 reflectance(float fresnel, float f0) const {
    if (fresnel >= 1.0F) return Vec3(1.0F);
    const float grazing = std::max(0.0F, (fresnel - f0) / (1.0F - f0));
    const Vec3 normal = glm::min(f0 * tint, Vec3(1.0F));
    return weight * (normal + (Vec3(1.0F) - normal) * grazing);
  }
};

/// Glass or water: one GGX boundary that reflects and refracts (Walter et al. 2007, "Microfacet Models for Refraction through Rough
/// Surfaces"). The single-scattering lobes are divided by their common albedo, so that without tint nothing is lost. Radiance: light that
/// enters the denser medium is compressed by the square of the index ratio.
struct DielectricBsdf {
  float eta = 1.5F;  ///< index of the far side over that of the viewer's side
  float alpha = 0.0F;
  const DielectricAlbedo* albedo_table = nullptr;  ///< of this boundary; needed when rough
  Vec3 tint{1.0F};                                 ///< factor on what is let through
  ReflectionFactors factors{};

  [[nodiscard]] BsdfValue evaluate(const Vec3& wo, const Vec3& wi) const;
  [[nodiscard]] BsdfSample sample(const Vec3& wo, float u_lobe, const Vec2& u) const;
  [[nodiscard]] Vec3 albedo(const Vec3& wo) const;
  /// An index of 1 bends nothing and reflects nothing, however rough.
  [[nodiscard]] bool is_delta() const { return alpha < kSmoothAlpha || eta == 1.0F; }

 private:
  /// At a facet that meets wo at this cosine.
  struct Facet {
    float fresnel;  ///< of the boundary itself
    Vec3 reflectance;
    float chance;  ///< of reflection
  };
  [[nodiscard]] Facet facet(float cosine) const;
  [[nodiscard]] float gain(const Vec3& wo) const;
};

/// A pane so thin that rays pass straight through: all orders of reflection between its two smooth faces in one. The geometric series
/// of R and T = 1 - R sums to R + T^2 R / (1 - R^2) = 2R / (1 + R) reflected.
struct ThinDielectricBsdf {
  float ior = 1.5F;

  [[nodiscard]] static BsdfValue evaluate(const Vec3& /*wo*/, const Vec3& /*wi*/) { return {}; }
  [[nodiscard]] BsdfSample sample(const Vec3& wo, float u_lobe, const Vec2& u) const;
  [[nodiscard]] static Vec3 albedo(const Vec3& /*wo*/) { return Vec3(1.0F); }
  [[nodiscard]] static bool is_delta() { return true; }
};

/// The thin-walled transmission of glTF (KHR_materials_transmission): a mirror lobe by Schlick, and what it leaves goes through without
/// refraction, blurred by the same lobe turned over, times the base colour.
struct ThinTransmissionBsdf {
  Vec3 tint{1.0F};
  GlossyLayer mirror{};

  [[nodiscard]] BsdfValue evaluate(const Vec3& wo, const Vec3& wi) const;
  [[nodiscard]] BsdfSample sample(const Vec3& wo, float u_lobe, const Vec2& u) const;
  [[nodiscard]] Vec3 albedo(const Vec3& wo) const;
  [[nodiscard]] bool is_delta() const { return mirror.is_smooth(); }
};

}  // namespace grove
