#include "grove/render/bsdf/gltf_layers.h"

#include "grove/render/sampling/warp.h"
#include "grove/render/surface/frame.h"

namespace grove {
namespace {

constexpr float kUniformHemisphere = 1.0F / (2.0F * kPi);

Vec3 sample_hemisphere(const Vec2& u) {
  const Vec3 w = sample_sphere(u);
  return {w.x, w.y, std::fabs(w.z)};
}

}  // namespace

float GltfLayersBsdf::coat_reflectance(const Vec3& wo) const {
  return coat_weight > 0.0F ? coat_weight * coat.albedo(std::max(0.0F, glm::dot(wo, coat_normal))).x : 0.0F;
}

GltfLayersBsdf::Chances GltfLayersBsdf::chances(const Vec3& wo) const {
  const float coat_part = coat_reflectance(wo);
  const float sheen_part = sheen.exists() ? max_component(sheen.colour) * sheen.white_albedo(wo.z) : 0.0F;
  const Vec3 core_albedo = std::visit([&](const auto& model) { return model.albedo(wo); }, core);
  const float core_part = sheen.scaling(wo.z, wo.z) * max_component(core_albedo);
  Chances result;
  result.coat = lobe_chance(coat_part, (1.0F - coat_part) * (sheen_part + core_part));
  if (sheen_part > 0.0F) result.sheen = (1.0F - result.coat) * (core_part > 0.0F ? sheen_part / (sheen_part + core_part) : 1.0F);
  return result;
}

BsdfValue GltfLayersBsdf::evaluate(const Vec3& wo, const Vec3& wi) const {
  const Chances chance = chances(wo);
  BsdfValue result = std::visit([&](const auto& model) { return model.evaluate(wo, wi); }, core);
  result.value *= sheen.scaling(wo.z, std::fabs(wi.z));
  result.pdf *= 1.0F - chance.coat - chance.sheen;
  if (chance.sheen > 0.0F && wi.z > 0.0F) {
    result.value += sheen.evaluate(wo, wi);
    result.pdf += chance.sheen * kUniformHemisphere;
  }
  if (!(coat_weight > 0.0F)) return result;
  result.value *= 1.0F - coat_reflectance(wo);
  if (wi.z > 0.0F && !coat.is_smooth()) {
    const Frame frame(coat_normal);
    const BsdfValue reflected = coat.evaluate(frame.to_local(wo), frame.to_local(wi));
    result.value += coat_weight * reflected.value;
    result.pdf += chance.coat * reflected.pdf;
  }
  return result;
}

BsdfSample GltfLayersBsdf::sample(const Vec3& wo, float u_lobe, const Vec2& u) const {
  const Chances chance = chances(wo);
  BsdfSample result;
  if (u_lobe < chance.coat) {
    const Frame frame(coat_normal);
    const Vec3 local = sample_mirror(frame.to_local(wo), coat.alpha, u);
    result.wi = glm::normalize(frame.to_world(local));
    if (local.z <= 0.0F || result.wi.z <= 0.0F) return {};
    if (coat.is_smooth()) {
      return {.wi = result.wi, .weight = Vec3(coat_reflectance(wo) / chance.coat), .pdf = chance.coat, .is_delta = true};
    }
  } else if (u_lobe < chance.coat + chance.sheen) {
    result.wi = sample_hemisphere(u);
  } else {
    const float own_chance = 1.0F - chance.coat - chance.sheen;
    if (!(own_chance > 0.0F)) return {};
    const float own_u = std::clamp((u_lobe - chance.coat - chance.sheen) / own_chance, 0.0F, 0x1.fffffep-1F);
    result = std::visit([&](const auto& model) { return model.sample(wo, own_u, u); }, core);
    if (!result) return {};
    if (result.is_delta) {
      result.weight *= (1.0F - coat_reflectance(wo)) * sheen.scaling(wo.z, std::fabs(result.wi.z)) / own_chance;
      result.pdf *= own_chance;
      return result;
    }
  }
  const BsdfValue value = evaluate(wo, result.wi);
  if (!(value.pdf > 0.0F)) return {};
  result.weight = value.value / value.pdf;
  result.pdf = value.pdf;
  return result;
}

Vec3 GltfLayersBsdf::albedo(const Vec3& wo) const {
  const float reflected = coat_reflectance(wo);
  const Vec3 below = std::visit([&](const auto& model) { return model.albedo(wo); }, core) * sheen.scaling(wo.z, wo.z);
  const Vec3 velvet = sheen.exists() ? sheen.colour * sheen.white_albedo(wo.z) : Vec3(0.0F);
  return Vec3(reflected) + (1.0F - reflected) * (velvet + below);
}

bool GltfLayersBsdf::is_delta() const {
  return std::visit([](const auto& model) { return model.is_delta(); }, core) && !sheen.exists() &&
         (!(coat_weight > 0.0F) || coat.is_smooth());
}

}  // namespace grove
