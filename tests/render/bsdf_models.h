#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "grove/render/bsdf/bsdf.h"

namespace grove::testing {

struct NamedBsdf {
  std::string name;
  Bsdf bsdf;
  bool is_lossless = false;    // gives back all light, in energy (not radiance)
  bool is_reciprocal = false;  // f(wo, wi) = f(wi, wo) for reflection

  friend std::ostream& operator<<(std::ostream& out, const NamedBsdf& model) { return out << model.name; }
};

inline const DielectricAlbedo& glass_table() {
  static const DielectricAlbedo table(1.5F);
  return table;
}

/// Every model, with rough, smooth, white and coloured parameters.
inline std::vector<NamedBsdf> all_models() {
  const Vec3 colour(0.8F, 0.5F, 0.2F);
  const Vec3 white(1.0F);
  const DielectricAlbedo* glass = &glass_table();
  const MetalFresnel silver{.has_complex_ior = true, .eta = Vec3(0.155F, 0.117F, 0.138F), .k = Vec3(4.8F, 3.1F, 2.1F)};
  const MetalFresnel coloured{.f0 = colour};
  const MetalFresnel perfect{.f0 = white};
  std::vector<NamedBsdf> models = {
      {"diffuse", DiffuseBsdf{colour}, false, true},
      {"diffuse_white", DiffuseBsdf{white}, true, true},
      {"diffuse_transmission", DiffuseTransmissionBsdf{0.3F * white, 0.7F * white}, true, true},
      {"thin_dielectric", ThinDielectricBsdf{1.5F}, true},
      {"glass_smooth", DielectricBsdf{.eta = 1.5F}, true},
      {"glass_smooth_inside", DielectricBsdf{.eta = 1.0F / 1.5F}, true},
      {"metal_silver", ConductorBsdf{silver, 0.09F}},
      {"metal_smooth", ConductorBsdf{coloured, 0.0F}},
      {"coated_diffuse_smooth_white", CoatedDiffuseBsdf{{1.5F, 0.0F, glass}, white}, true, true},
      {"coated_metal_smooth", CoatedConductorBsdf{{1.5F, 0.0F, glass}, {perfect, 0.0F}}, true},
      {"gltf_smooth_white", MetallicRoughnessBsdf{.base_colour = white, .alpha = 0.0F}, true, true},
      {"thin_transmission_smooth", ThinTransmissionBsdf{.tint = white, .mirror = {.alpha = 0.0F}}, true},
  };
  const MetallicRoughnessBsdf matt{.base_colour = white, .alpha = 0.5F};
  const SheenLayer velvet{.colour = {0.9F, 0.6F, 1.0F}, .alpha = 0.25F};
  const GlossyLayer smooth_coat{.alpha = 0.0F};
  const ReflectionFactors dull{.weight = 0.3F, .tint = {1.0F, 0.5F, 2.0F}};
  const DielectricBsdf dull_glass{.eta = 1.5F, .alpha = 0.2F, .albedo_table = glass, .tint = white, .factors = dull};
  models.push_back({"glass_smooth_dull", DielectricBsdf{.eta = 1.5F, .factors = dull}});
  models.push_back({"glass_dull", dull_glass});
  models.push_back({"glass_unreflecting", DielectricBsdf{.eta = 1.5F, .factors = {.weight = 0.0F}}, true});
  // Without a specular part the surface is Lambert's.
  models.push_back(
      {"gltf_specular_0", MetallicRoughnessBsdf{.alpha = 0.4F, .dielectric_f0 = Vec3(0.0F), .dielectric_f90 = 0.0F}, true, true});
  models.push_back(
      {"gltf_specular_tinted", MetallicRoughnessBsdf{.base_colour = colour, .alpha = 0.3F, .dielectric_f0 = {0.04F, 0.2F, 0.0F}}});
  models.push_back({"gltf_specular_all", MetallicRoughnessBsdf{.alpha = 0.3F, .dielectric_f0 = white}, true});
  models.push_back({"thin_tinted", ThinTransmissionBsdf{.tint = colour, .mirror = {.f0 = {0.1F, 0.0F, 0.3F}, .f90 = 0.7F, .alpha = 0.3F}}});
  models.push_back({"coat_smooth", GltfLayersBsdf{.core = matt, .coat_weight = 1.0F, .coat = smooth_coat}, true});
  models.push_back(
      {"coat_tilted", GltfLayersBsdf{.core = matt, .coat_weight = 0.6F, .coat = {.alpha = 0.2F}, .coat_normal = {0.28F, 0, 0.96F}}});
  models.push_back({"coat_on_glass", GltfLayersBsdf{.core = dull_glass, .coat_weight = 1.0F, .coat = {.alpha = 0.3F}}});
  models.push_back({"coat_on_velvet", GltfLayersBsdf{.core = matt, .sheen = velvet, .coat_weight = 0.5F, .coat = {.alpha = 0.3F}}});
  models.push_back(
      {"velvet_on_pane", GltfLayersBsdf{.core = ThinTransmissionBsdf{.tint = white, .mirror = {.alpha = 0.4F}}, .sheen = velvet}});
  for (const float alpha : {0.1F, 0.25F, 0.7F}) {
    const auto add = [&](const std::string& name, const Bsdf& bsdf, bool is_lossless) {
      models.push_back({name + "_" + std::to_string(static_cast<int>(alpha * 100.0F + 0.5F)), bsdf, is_lossless});
    };
    add("metal", ConductorBsdf{coloured, alpha}, false);
    add("metal_white", ConductorBsdf{perfect, alpha}, true);
    add("glass", DielectricBsdf{.eta = 1.5F, .alpha = alpha, .albedo_table = glass}, true);
    add("glass_inside", DielectricBsdf{.eta = 1.0F / 1.5F, .alpha = alpha, .albedo_table = glass}, true);
    add("thin_transmission", ThinTransmissionBsdf{.tint = white, .mirror = {.alpha = alpha}}, true);
    add("coated_diffuse", CoatedDiffuseBsdf{{1.5F, alpha, glass}, colour}, false);
    add("coated_diffuse_white", CoatedDiffuseBsdf{{1.5F, alpha, glass}, white}, true);
    add("coated_metal", CoatedConductorBsdf{{1.5F, alpha, glass}, {coloured, 0.2F}}, false);
    add("gltf", MetallicRoughnessBsdf{.base_colour = colour, .metallic = 0.4F, .alpha = alpha}, false);
    add("gltf_white_dielectric", MetallicRoughnessBsdf{.base_colour = white, .metallic = 0.0F, .alpha = alpha}, true);
    const MetallicRoughnessBsdf lambert{.base_colour = colour, .dielectric_f0 = Vec3(0.0F), .dielectric_f90 = 0.0F};
    models.push_back({"velvet_" + std::to_string(static_cast<int>(alpha * 100.0F + 0.5F)),
                      GltfLayersBsdf{.core = lambert, .sheen = {.colour = colour, .alpha = alpha}}, false, true});
    add("coat", GltfLayersBsdf{.core = matt, .coat_weight = 1.0F, .coat = {.alpha = alpha}}, true);
    add("gltf_white_metal", MetallicRoughnessBsdf{.base_colour = white, .metallic = 1.0F, .alpha = alpha}, true);
  }
  return models;
}

}  // namespace grove::testing
