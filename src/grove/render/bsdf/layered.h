#pragma once

#include "grove/render/bsdf/conductor.h"
#include "grove/render/bsdf/dielectric.h"
#include "grove/render/bsdf/glossy_layer.h"

// Surfaces of two layers. The layers are not simulated: what the upper one lets through lights the lower one, and what goes to and fro
// between them is summed in closed form, so that a lossless lower layer makes a lossless whole.

namespace grove {

/// The upper layer: a dielectric boundary seen from outside.
struct Coat {
  float ior = 1.5F;
  float alpha = 0.0F;
  const DielectricAlbedo* table = nullptr;  ///< of `ior`; always needed

  [[nodiscard]] bool is_smooth() const { return alpha < kSmoothAlpha; }
  /// All that is reflected of light from (or to) the direction with this cosine.
  [[nodiscard]] float reflectance(float cosine) const;
  /// The cosine-weighted mean of `reflectance`.
  [[nodiscard]] float mean_reflectance() const { return table->mean_reflectance[0](is_smooth() ? 0.0F : alpha); }
  /// The value and density of the rough mirror lobe; zeros when smooth.
  [[nodiscard]] BsdfValue evaluate(const Vec3& wo, const Vec3& wi) const;
};

/// Lambert's reflector under a coat: glossy paint, varnished wood, ceramics.
///
/// Light gets in by T(wi), is scattered, and gets out by T(wo) or is thrown back from below and scattered again, which sums to a
/// geometric series (Saunderson 1942, "Calculation of the Color of Pigmented Plastics"):
///   f = T(wo) T(wi) / (pi (1 - R)) * rho (1 - r) / (1 - rho r),
/// with R the mean reflectance of the coat from outside and r = 1 - (1 - R) / ior^2 that from inside.
struct CoatedDiffuseBsdf {
  Coat coat;
  Vec3 reflectance{0.5F};

  [[nodiscard]] BsdfValue evaluate(const Vec3& wo, const Vec3& wi) const;
  [[nodiscard]] BsdfSample sample(const Vec3& wo, float u_lobe, const Vec2& u) const;
  [[nodiscard]] Vec3 albedo(const Vec3& wo) const;
  [[nodiscard]] static bool is_delta() { return false; }

 private:
  [[nodiscard]] Vec3 base_albedo() const;
  [[nodiscard]] float coat_chance(const Vec3& wo) const;
};

/// A metal under a coat. `base.fresnel` is relative to the coat's index; it is looked up at the refracted angle. With T the geometric mean
/// of the coat's transmittances for wo and wi, the metal's reflectance F becomes T^2 F / (1 - (1 - T) F), the sum over bounces
/// between metal and coat.
struct CoatedConductorBsdf {
  Coat coat;
  ConductorBsdf base;

  [[nodiscard]] BsdfValue evaluate(const Vec3& wo, const Vec3& wi) const;
  [[nodiscard]] BsdfSample sample(const Vec3& wo, float u_lobe, const Vec2& u) const;
  [[nodiscard]] Vec3 albedo(const Vec3& wo) const;
  [[nodiscard]] bool is_delta() const { return coat.is_smooth() && base.is_delta(); }

 private:
  [[nodiscard]] Vec3 base_reflectance(float facet_cosine, float cosine_o, float cosine_i) const;
  [[nodiscard]] float coat_chance(const Vec3& wo) const;
};

/// The core of glTF 2.0 (appendix B) with KHR_materials_ior and _specular: a dielectric with a diffuse base, blended with a metal. The mirror
/// lobe goes from mix(dielectric_f0, base colour, metallic) to mix(dielectric_f90, 1, metallic); the diffuse part gets what the dielectric's mirror lobe leaves it, by directional
/// albedo on the way in and out (Kelemen and Szirmay-Kalos 2001, "A Microfacet Based Coupled Specular-Matte BRDF Model").
struct MetallicRoughnessBsdf {
  Vec3 base_colour{1.0F};
  float metallic = 0.0F;
  float alpha = 1.0F;
  Vec3 dielectric_f0{0.04F};
  float dielectric_f90 = 1.0F;

  [[nodiscard]] BsdfValue evaluate(const Vec3& wo, const Vec3& wi) const;
  [[nodiscard]] BsdfSample sample(const Vec3& wo, float u_lobe, const Vec2& u) const;
  [[nodiscard]] Vec3 albedo(const Vec3& wo) const;
  [[nodiscard]] bool is_delta() const { return alpha < kSmoothAlpha && metallic >= 1.0F; }

 private:
  /// What depends on wo alone.
  struct View {
    GlossyLayer mirror;
    float dielectric_albedo;
    float mirror_chance;
  };
  [[nodiscard]] GlossyLayer mirror() const;
  /// Of the most reflected colour, so that the light below keeps its hue.
  [[nodiscard]] float dielectric_albedo(float cosine) const;
  [[nodiscard]] View view(const Vec3& wo) const;
  [[nodiscard]] BsdfValue evaluate(const View& view, const Vec3& wo, const Vec3& wi) const;
  [[nodiscard]] Vec3 diffuse(float albedo_o, float cosine_i) const;
};

}  // namespace grove
