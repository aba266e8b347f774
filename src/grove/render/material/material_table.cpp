#include "grove/render/material/material_table.h"

#include <algorithm>
#include <cmath>
#include <glm/exponential.hpp>

#include "grove/render/material/opacity.h"
#include "grove/render/surface/perturb_normal.h"
#include "grove/render/texture/evaluate_texture.h"

namespace grove {
namespace {

// A coat that is thinner than the air around it is no coat.
float coat_ior(float ior) {
  return std::max(1.0F, usable_ior(ior));
}

// Reflectances above 1 would make light from nothing.
Vec3 reflectance(const Vec3& colour) {
  return glm::clamp(colour, Vec3(0.0F), Vec3(1.0F));
}

bool is_glossy_glass(const Material& material) {
  if (material.roughness.value == 0.0F && material.roughness.texture == kNoTexture) return false;
  return material.kind == MaterialKind::dielectric ||
         (material.kind == MaterialKind::metallic_roughness && material.transmission.value > 0.0F && !material.thin_walled);
}

bool has_coat(const Material& material) {
  return material.kind == MaterialKind::coated_diffuse || material.kind == MaterialKind::coated_conductor;
}

float unit(float value) {
  return value > 0.0F ? std::min(value, 1.0F) : 0.0F;
}

float ggx_alpha(const Scene& scene, const ScalarParameter& roughness, const TextureCoordinates& uv) {
  const float perceptual = unit(evaluate(scene, roughness, uv));
  return perceptual * perceptual;
}

// The coefficient of Beer's law: attenuation_colour is left after attenuation_distance.
Vec3 absorption_inside(const Material& material) {
  if (material.kind != MaterialKind::metallic_roughness || material.thin_walled || !(material.transmission.value > 0.0F)) return Vec3(0.0F);
  // Not quite black, so that a way of no length still lets everything through.
  const Vec3 colour = glm::clamp(material.attenuation_colour, Vec3(1e-6F), Vec3(1.0F));
  return -glm::log(colour) / material.attenuation_distance;
}

}  // namespace

MaterialTable::MaterialTable(const Scene& scene) : scene_(&scene) {
  absorption_.reserve(scene.materials.size());
  for (const Material& material : scene.materials) {
    absorption_.push_back(absorption_inside(material));
    any_absorbs_inside_ = any_absorbs_inside_ || absorption_.back() != Vec3(0.0F);
    const bool passes = grove::can_pass_light(scene, material);
    can_pass_light_.push_back(passes ? 1 : 0);
    any_can_pass_light_ = any_can_pass_light_ || passes;
    if (!has_coat(material) && !is_glossy_glass(material)) continue;
    const float ior = has_coat(material) ? coat_ior(material.ior) : usable_ior(material.ior);
    if (auto& entry = tables_[ior]; entry == nullptr) entry = std::make_unique<DielectricAlbedo>(ior);
  }
  // Made here, outside of parallel work.
  (void)ggx_albedo();
  const auto has_sheen = [](const Material& material) { return material.sheen_colour.value != Vec3(0.0F); };
  if (std::ranges::any_of(scene.materials, has_sheen)) (void)sheen_albedo();
}

const DielectricAlbedo* MaterialTable::table(float ior) const {
  const auto found = tables_.find(ior);
  return found == tables_.end() ? nullptr : found->second.get();
}

Vec3 MaterialTable::transmittance_inside(std::uint32_t material, float distance) const {
  return glm::exp(-absorption_[material] * distance);
}

Vec3 MaterialTable::shading_normal(const SurfacePoint& point) const {
  const Material& material = scene_->materials[point.material];
  if (material.normal_texture == kNoTexture && material.bump.texture == kNoTexture) return point.shading_normal;
  return perturbed_normal(*scene_, material, point);
}

Bsdf MaterialTable::bsdf(const SurfacePoint& point, const SurfaceView& view, float u) const {
  const Material* chosen = &scene_->materials[point.material];
  while (chosen->kind == MaterialKind::mix) {
    float amount = unit(evaluate(*scene_, chosen->mix_amount, point.coordinates()));
    if (can_pass_light_[point.material] != 0) {
      // Light has met the surface already, more likely the material that lets less of it pass.
      const float first = (1.0F - amount) * opacity(*scene_, scene_->materials[chosen->mix_material[0]], point.surface_coordinates());
      const float second = amount * opacity(*scene_, scene_->materials[chosen->mix_material[1]], point.surface_coordinates());
      if (first + second > 0.0F) amount = second / (first + second);
    }
    const bool is_second = u < amount;
    chosen = &scene_->materials[chosen->mix_material[is_second ? 1 : 0]];
    u = is_second ? u / amount : (u - amount) / (1.0F - amount);
  }
  const Material& material = *chosen;
  const TextureCoordinates uv = point.coordinates();
  const auto base_colour = [&] { return reflectance(evaluate(*scene_, material.base_colour, uv) * Vec3(point.colour)); };
  const auto metal = [&](float outer_ior) {
    MetalFresnel fresnel{.has_complex_ior = material.has_complex_ior};
    if (material.has_complex_ior) {
      fresnel.eta = material.ior_colour / outer_ior;
      fresnel.k = material.absorption / outer_ior;
    } else {
      fresnel.f0 = base_colour();
    }
    return ConductorBsdf{.fresnel = fresnel, .alpha = ggx_alpha(*scene_, material.roughness, uv)};
  };
  switch (material.kind) {
    case MaterialKind::metallic_roughness:
      return gltf_bsdf(*scene_, material, point, view, table(usable_ior(material.ior)), u);
    case MaterialKind::diffuse:
      return DiffuseBsdf{base_colour()};
    case MaterialKind::coated_diffuse: {
      const float ior = coat_ior(material.ior);
      return CoatedDiffuseBsdf{.coat = {ior, ggx_alpha(*scene_, material.roughness, uv), table(ior)}, .reflectance = base_colour()};
    }
    case MaterialKind::conductor:
      return metal(1.0F);
    case MaterialKind::coated_conductor: {
      const float ior = coat_ior(material.ior);
      return CoatedConductorBsdf{.coat = {ior, ggx_alpha(*scene_, material.coat_roughness, uv), table(ior)}, .base = metal(ior)};
    }
    case MaterialKind::dielectric: {
      const float ior = usable_ior(material.ior);
      return DielectricBsdf{
          .eta = view.is_outside ? ior : 1.0F / ior, .alpha = ggx_alpha(*scene_, material.roughness, uv), .albedo_table = table(ior)};
    }
    case MaterialKind::thin_dielectric:
      return ThinDielectricBsdf{usable_ior(material.ior)};
    case MaterialKind::diffuse_transmission:
      return DiffuseTransmissionBsdf{base_colour(), reflectance(evaluate(*scene_, material.transmission_colour, uv))};
    case MaterialKind::interface:
    case MaterialKind::mix:
      break;  // an interface lets everything pass before this is asked, and a mix was resolved above
  }
  return DiffuseBsdf{Vec3(0.0F)};
}

}  // namespace grove
