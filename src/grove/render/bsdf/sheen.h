#pragma once

#include "grove/render/bsdf/albedo_tables.h"
#include "grove/render/bsdf/bsdf_types.h"

namespace grove {

/// Below this width the fibres' distribution is narrower than the tables of its albedo resolve: a perceptual roughness of 0.07.
inline constexpr float kLeastSheenAlpha = 5e-3F;

/// Velvet: fibres that stand on a surface, by the inverted Gaussian "Charlie" of Estevez and Kulla 2017, "Production Friendly Microfacet
/// Sheen BRDF" (eq. 2 for their distribution, eq. 3 for the fitted shadowing), as glTF has it (KHR_materials_sheen).
struct SheenLayer {
  Vec3 colour{0.0F};
  float alpha = 1.0F;  ///< from kLeastSheenAlpha to 1

  [[nodiscard]] bool exists() const { return max_component(colour) > 0.0F; }

  /// The scattering function times |wi.z|; 0 unless both directions are above the surface.
  [[nodiscard]] Vec3 evaluate(const Vec3& wo, const Vec3& wi) const;

  /// The part that a white sheen reflects of light from the direction with this cosine, at most 1.
  [[nodiscard]] float white_albedo(float cosine) const;

  /// What the surface below keeps of its own, by the albedo scaling of KHR_materials_sheen: the lesser of what both directions let
  /// through, so that it is reciprocal.
  [[nodiscard]] float scaling(float cosine_o, float cosine_i) const;
};

/// The single-scattering value of a white sheen, without its cosine.
[[nodiscard]] float charlie_sheen(const Vec3& wo, const Vec3& wi, float alpha);

/// The albedo of a white sheen by cosine and alpha, made on first use; any number of threads may call it.
[[nodiscard]] const AlbedoTable& sheen_albedo();

}  // namespace grove
