#include "grove/render/bsdf/dielectric.h"

#include "grove/render/bsdf/conductor.h"

namespace grove {

float DielectricBsdf::gain(const Vec3& wo) const {
  const std::size_t side = (eta >= 1.0F) == (albedo_table->ior >= 1.0F) ? 0 : 1;
  return 1.0F / std::max(0.05F, albedo_table->total[side](wo.z, alpha));
}

DielectricBsdf::Facet DielectricBsdf::facet(float cosine) const {
  const float fresnel = fresnel_dielectric(std::clamp(cosine, 0.0F, 1.0F), eta);
  const float f0 = (eta - 1.0F) * (eta - 1.0F) / ((eta + 1.0F) * (eta + 1.0F));
  if (factors.weight == 1.0F && factors.tint == Vec3(1.0F)) return {fresnel, Vec3(fresnel), fresnel};
  const Vec3 reflectance = factors.reflectance(fresnel, f0);
  return {fresnel, reflectance, max_component(reflectance)};
}

BsdfValue DielectricBsdf::evaluate(const Vec3& wo, const Vec3& wi) const {
  if (is_delta() || wi.z == 0.0F) return {};
  if (wi.z > 0.0F) {
    const MirrorPair pair = mirror_pair(wo, wi, alpha);
    if (!(pair.density > 0.0F)) return {};
    const Facet seen = facet(pair.facet_cosine);
    return {seen.reflectance * (pair.density * pair.shadowing * gain(wo)), pair.density * seen.chance};
  }
  // The facet that bends wo to wi (Walter et al. 2007, eq. 16), on the viewer's side.
  Vec3 m = glm::normalize(wi * eta + wo);
  if (m.z < 0.0F) m = -m;
  const float cosine_o = glm::dot(wo, m);
  const float cosine_i = glm::dot(wi, m);
  if (cosine_o <= 0.0F || cosine_i >= 0.0F) return {};
  const Facet seen = facet(cosine_o);
  const float denominator = cosine_i + cosine_o / eta;
  const float density = ggx_visible_density(wo, m, alpha) * -cosine_i / (denominator * denominator);
  const float pdf = (1.0F - seen.chance) * density;
  if (!(pdf > 0.0F) || !std::isfinite(pdf)) return {};
  float through = (1.0F - seen.fresnel) * ggx_shadowing_over_masking(wo, wi, alpha);
  if (seen.fresnel > seen.chance) {
    // What the factors take from this facet's reflection goes through as well: as much as would have got away from the surface.
    const Vec3 mirrored = reflect_about(wo, m);
    if (mirrored.z > 0.0F) through += (seen.fresnel - seen.chance) * ggx_shadowing_over_masking(wo, mirrored, alpha);
  }
  return {tint * (through * density * gain(wo) / (eta * eta)), pdf};
}

BsdfSample DielectricBsdf::sample(const Vec3& wo, float u_lobe, const Vec2& u) const {
  if (eta == 1.0F) return {.wi = -wo, .weight = tint, .pdf = 1.0F, .is_delta = true};
  const bool smooth = is_delta();
  const Vec3 m = smooth ? Vec3(0.0F, 0.0F, 1.0F) : sample_ggx_visible_normal(wo, alpha, u);
  const Facet seen = facet(glm::dot(wo, m));
  BsdfSample result;
  if (u_lobe < seen.chance) {
    result.wi = reflect_about(wo, m);
    if (smooth) return {.wi = result.wi, .weight = seen.reflectance / seen.chance, .pdf = seen.chance, .is_delta = true};
    if (result.wi.z <= 0.0F) return {};
  } else {
    if (!refract_about(wo, m, eta, result.wi)) return {};
    result.eta_squared = eta * eta;
    if (smooth) {
      return {.wi = result.wi,
              .weight = tint / result.eta_squared,
              .pdf = 1.0F - seen.chance,
              .is_delta = true,
              .eta_squared = result.eta_squared};
    }
    if (result.wi.z >= 0.0F) return {};
  }
  const BsdfValue value = evaluate(wo, result.wi);
  if (!(value.pdf > 0.0F)) return {};
  result.weight = value.value / value.pdf;
  result.pdf = value.pdf;
  return result;
}

Vec3 DielectricBsdf::albedo(const Vec3& wo) const {
  const Facet seen = facet(wo.z);
  return seen.reflectance + (1.0F - seen.chance) * tint;
}

BsdfSample ThinDielectricBsdf::sample(const Vec3& wo, float u_lobe, const Vec2& /*u*/) const {
  const float once = fresnel_dielectric(wo.z, ior);
  const float reflected = 2.0F * once / (1.0F + once);
  if (u_lobe < reflected) return {.wi = {-wo.x, -wo.y, wo.z}, .weight = Vec3(1.0F), .pdf = reflected, .is_delta = true};
  return {.wi = -wo, .weight = Vec3(1.0F), .pdf = 1.0F - reflected, .is_delta = true};
}

BsdfValue ThinTransmissionBsdf::evaluate(const Vec3& wo, const Vec3& wi) const {
  if (is_delta()) return {};
  const float chance = max_component(mirror.albedo(wo.z));
  if (wi.z > 0.0F) {
    const BsdfValue reflected = mirror.evaluate(wo, wi);
    return {reflected.value, reflected.pdf * chance};
  }
  const MirrorPair pair = mirror_pair(wo, {wi.x, wi.y, -wi.z}, mirror.alpha);
  if (!(pair.density > 0.0F)) return {};
  // The lobe is brought to unit albedo, so that exactly what is not reflected goes through.
  const Vec3 through = tint * ((1.0F - chance) * multiple_scattering_gain(wo.z, mirror.alpha, Vec3(1.0F)).x);
  return {through * (pair.density * pair.shadowing), pair.density * (1.0F - chance)};
}

BsdfSample ThinTransmissionBsdf::sample(const Vec3& wo, float u_lobe, const Vec2& u) const {
  const Vec3 reflectance = mirror.albedo(wo.z);
  const float chance = max_component(reflectance);
  const bool reflected = u_lobe < chance;
  Vec3 wi = sample_mirror(wo, mirror.alpha, u);
  if (wi.z <= 0.0F) return {};
  if (!reflected) wi.z = -wi.z;
  if (is_delta()) {
    return {.wi = wi, .weight = reflected ? reflectance / chance : tint, .pdf = reflected ? chance : 1.0F - chance, .is_delta = true};
  }
  const BsdfValue value = evaluate(wo, wi);
  if (!(value.pdf > 0.0F)) return {};
  return {.wi = wi, .weight = value.value / value.pdf, .pdf = value.pdf};
}

Vec3 ThinTransmissionBsdf::albedo(const Vec3& wo) const {
  const Vec3 reflectance = mirror.albedo(wo.z);
  return reflectance + (1.0F - max_component(reflectance)) * tint;
}

}  // namespace grove
