#pragma once

#include <variant>

#include "grove/render/bsdf/dielectric.h"
#include "grove/render/bsdf/glossy_layer.h"
#include "grove/render/bsdf/layered.h"
#include "grove/render/bsdf/sheen.h"

namespace grove {

/// What glTF puts on its core material: a sheen, and a clear coat on top of that (KHR_materials_sheen and KHR_materials_clearcoat). Each
/// layer lets through what it does not reflect: the coat by its albedo for wo alone, as the extension has it, so that it loses nothing and is
/// not reciprocal; the sheen as SheenLayer::scaling says.
struct GltfLayersBsdf {
  using Core = std::variant<MetallicRoughnessBsdf, DielectricBsdf, ThinTransmissionBsdf>;

  Core core;
  SheenLayer sheen{};
  float coat_weight = 0.0F;                   ///< the part of the surface that the coat covers
  GlossyLayer coat{};                         ///< of reflectance 0.04
  Vec3 coat_normal = Vec3(0.0F, 0.0F, 1.0F);  ///< in the frame of the shading normal, of unit length, on the side of wo

  [[nodiscard]] BsdfValue evaluate(const Vec3& wo, const Vec3& wi) const;
  [[nodiscard]] BsdfSample sample(const Vec3& wo, float u_lobe, const Vec2& u) const;
  [[nodiscard]] Vec3 albedo(const Vec3& wo) const;
  [[nodiscard]] bool is_delta() const;

 private:
  /// The chances of the lobes; the core has the rest.
  struct Chances {
    float coat = 0.0F;
    float sheen = 0.0F;
  };
  [[nodiscard]] float coat_reflectance(const Vec3& wo) const;
  [[nodiscard]] Chances chances(const Vec3& wo) const;
};

}  // namespace grove
