#include "grove/render/bsdf/layered.h"
#include "grove/render/sampling/warp.h"

namespace grove {

float Coat::reflectance(float cosine) const {
  if (is_smooth()) return fresnel_dielectric(cosine, ior);
  return std::min(1.0F, table->reflected[0](cosine, alpha) / std::max(0.05F, table->total[0](cosine, alpha)));
}

BsdfValue Coat::evaluate(const Vec3& wo, const Vec3& wi) const {
  if (is_smooth()) return {};
  const MirrorPair pair = mirror_pair(wo, wi, alpha);
  if (!(pair.density > 0.0F)) return {};
  const float gain = 1.0F / std::max(0.05F, table->total[0](wo.z, alpha));
  return {Vec3(pair.density * fresnel_dielectric(pair.facet_cosine, ior) * pair.shadowing * gain), pair.density};
}

Vec3 CoatedDiffuseBsdf::base_albedo() const {
  const float inner = 1.0F - (1.0F - coat.mean_reflectance()) / (coat.ior * coat.ior);
  return reflectance * (1.0F - inner) / (Vec3(1.0F) - reflectance * inner);
}

float CoatedDiffuseBsdf::coat_chance(const Vec3& wo) const {
  const float mirror = coat.reflectance(wo.z);
  return lobe_chance(mirror, (1.0F - mirror) * max_component(base_albedo()));
}

BsdfValue CoatedDiffuseBsdf::evaluate(const Vec3& wo, const Vec3& wi) const {
  if (wi.z <= 0.0F) return {};
  const float chance = coat_chance(wo);
  const float through = (1.0F - coat.reflectance(wo.z)) * (1.0F - coat.reflectance(wi.z)) / (1.0F - coat.mean_reflectance());
  const BsdfValue mirror = coat.evaluate(wo, wi);
  return {mirror.value + base_albedo() * (through * wi.z / kPi), chance * mirror.pdf + (1.0F - chance) * wi.z / kPi};
}

BsdfSample CoatedDiffuseBsdf::sample(const Vec3& wo, float u_lobe, const Vec2& u) const {
  const float chance = coat_chance(wo);
  Vec3 wi;
  if (u_lobe < chance) {
    wi = sample_mirror(wo, coat.alpha, u);
    if (coat.is_smooth()) return {.wi = wi, .weight = Vec3(coat.reflectance(wo.z) / chance), .pdf = chance, .is_delta = true};
  } else {
    wi = sample_cosine_hemisphere(u);
  }
  const BsdfValue value = evaluate(wo, wi);
  if (!(value.pdf > 0.0F)) return {};
  return {.wi = wi, .weight = value.value / value.pdf, .pdf = value.pdf};
}

Vec3 CoatedDiffuseBsdf::albedo(const Vec3& wo) const {
  const float mirror = coat.reflectance(wo.z);
  return Vec3(mirror) + (1.0F - mirror) * base_albedo();
}

Vec3 CoatedConductorBsdf::base_reflectance(float facet_cosine, float cosine_o, float cosine_i) const {
  const float sine_squared = (1.0F - facet_cosine * facet_cosine) / (coat.ior * coat.ior);
  const Vec3 metal = base.fresnel(std::sqrt(std::max(0.0F, 1.0F - sine_squared)));
  const float squared = (1.0F - coat.reflectance(cosine_o)) * (1.0F - coat.reflectance(cosine_i));
  return metal * squared / (Vec3(1.0F) - (1.0F - std::sqrt(squared)) * metal);
}

float CoatedConductorBsdf::coat_chance(const Vec3& wo) const {
  const float mirror = coat.reflectance(wo.z);
  return lobe_chance(mirror, max_component(base_reflectance(wo.z, wo.z, wo.z)));
}

BsdfValue CoatedConductorBsdf::evaluate(const Vec3& wo, const Vec3& wi) const {
  if (wi.z <= 0.0F) return {};
  const float chance = coat_chance(wo);
  BsdfValue result = coat.evaluate(wo, wi);
  result.pdf *= chance;
  if (!base.is_delta()) {
    const MirrorPair pair = mirror_pair(wo, wi, base.alpha);
    const Vec3 gain = multiple_scattering_gain(wo.z, base.alpha, base.fresnel(1.0F));
    result.value += base_reflectance(pair.facet_cosine, wo.z, wi.z) * gain * (pair.density * pair.shadowing);
    result.pdf += (1.0F - chance) * pair.density;
  }
  return result;
}

BsdfSample CoatedConductorBsdf::sample(const Vec3& wo, float u_lobe, const Vec2& u) const {
  const float chance = coat_chance(wo);
  const bool from_coat = u_lobe < chance;
  const bool is_delta_lobe = from_coat ? coat.is_smooth() : base.is_delta();
  const Vec3 wi = sample_mirror(wo, from_coat ? coat.alpha : base.alpha, u);
  if (is_delta_lobe) {
    const Vec3 reflected = from_coat ? Vec3(coat.reflectance(wo.z)) : base_reflectance(wo.z, wo.z, wo.z);
    const float own_chance = from_coat ? chance : 1.0F - chance;
    return {.wi = wi, .weight = reflected / own_chance, .pdf = own_chance, .is_delta = true};
  }
  const BsdfValue value = evaluate(wo, wi);
  if (!(value.pdf > 0.0F)) return {};
  return {.wi = wi, .weight = value.value / value.pdf, .pdf = value.pdf};
}

Vec3 CoatedConductorBsdf::albedo(const Vec3& wo) const {
  return Vec3(coat.reflectance(wo.z)) + base_reflectance(wo.z, wo.z, wo.z);
}

}  // namespace grove
