#include "grove/render/bsdf/dielectric.h"

#include "grove/render/bsdf/conductor.h"

namespace grove {

float DielectricBsdf::gain(const Vec3& wo) const {
  const std::size_t side = (eta >= 1.0F) == (albedo_table->ior >= 1.0F) ? 0 : 1;
  return 1.0F / std::max(0.05F, albedo_table->total[side](wo.z, alpha));
}

BsdfValue DielectricBsdf::evaluate(const Vec3& wo, const Vec3& wi) const {
  if (is_delta() || wi.z == 0.0F) return {};
  if (wi.z > 0.0F) {
    const MirrorPair pair = mirror_pair(wo, wi, alpha);
    if (!(pair.density > 0.0F)) return {};
    const float pdf = pair.density * fresnel_dielectric(pair.facet_cosine, eta);
    return {Vec3(pdf * pair.shadowing * gain(wo)), pdf};
  }
  // The facet that bends wo to wi (Walter et al. 2007, eq. 16), on the viewer's side.
  Vec3 m = glm::normalize(wi * eta + wo);
  if (m.z < 0.0F) m = -m;
  const float cosine_o = glm::dot(wo, m);
  const float cosine_i = glm::dot(wi, m);
  if (cosine_o <= 0.0F || cosine_i >= 0.0F) return {};
  const float fresnel = fresnel_dielectric(std::min(1.0F, cosine_o), eta);
  const float denominator = cosine_i + cosine_o / eta;
  const float pdf = (1.0F - fresnel) * ggx_visible_density(wo, m, alpha) * -cosine_i / (denominator * denominator);
  if (!(pdf > 0.0F) || !std::isfinite(pdf)) return {};
  return {tint * (pdf * ggx_shadowing_over_masking(wo, wi, alpha) * gain(wo) / (eta * eta)), pdf};
}

BsdfSample DielectricBsdf::sample(const Vec3& wo, float u_lobe, const Vec2& u) const {
  if (eta == 1.0F) return {.wi = -wo, .weight = tint, .pdf = 1.0F, .is_delta = true};
  const bool smooth = is_delta();
  const Vec3 m = smooth ? Vec3(0.0F, 0.0F, 1.0F) : sample_ggx_visible_normal(wo, alpha, u);
  const float fresnel = fresnel_dielectric(std::clamp(glm::dot(wo, m), 0.0F, 1.0F), eta);
  BsdfSample result;
  if (u_lobe < fresnel) {
    result.wi = reflect_about(wo, m);
    if (smooth) return {.wi = result.wi, .weight = Vec3(1.0F), .pdf = fresnel, .is_delta = true};
    if (result.wi.z <= 0.0F) return {};
  } else {
    if (!refract_about(wo, m, eta, result.wi)) return {};
    result.eta_squared = eta * eta;
    if (smooth) {
      return {
          .wi = result.wi, .weight = tint / result.eta_squared, .pdf = 1.0F - fresnel, .is_delta = true, .eta_squared = result.eta_squared};
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
  const float fresnel = fresnel_dielectric(wo.z, eta);
  return Vec3(fresnel) + (1.0F - fresnel) * tint;
}

BsdfSample ThinDielectricBsdf::sample(const Vec3& wo, float u_lobe, const Vec2& /*u*/) const {
  const float once = fresnel_dielectric(wo.z, ior);
  const float reflected = 2.0F * once / (1.0F + once);
  if (u_lobe < reflected) return {.wi = {-wo.x, -wo.y, wo.z}, .weight = Vec3(1.0F), .pdf = reflected, .is_delta = true};
  return {.wi = -wo, .weight = Vec3(1.0F), .pdf = 1.0F - reflected, .is_delta = true};
}

float ThinTransmissionBsdf::reflectance(const Vec3& wo) const {
  if (is_delta()) return f0 + (1.0F - f0) * schlick_weight(wo.z);
  const GgxAlbedo& table = ggx_albedo();
  const float single = f0 * table.scale(wo.z, alpha) + table.bias(wo.z, alpha);
  return std::min(1.0F, single * multiple_scattering_gain(wo.z, alpha, Vec3(f0)).x);
}

BsdfValue ThinTransmissionBsdf::evaluate(const Vec3& wo, const Vec3& wi) const {
  if (is_delta()) return {};
  const MirrorPair pair = mirror_pair(wo, {wi.x, wi.y, std::fabs(wi.z)}, alpha);
  if (!(pair.density > 0.0F)) return {};
  const float chance = reflectance(wo);
  if (wi.z > 0.0F) {
    const Vec3 fresnel = fresnel_schlick(pair.facet_cosine, Vec3(f0)) * multiple_scattering_gain(wo.z, alpha, Vec3(f0));
    return {fresnel * (pair.density * pair.shadowing), pair.density * chance};
  }
  // The lobe is brought to unit albedo, so that exactly what is not reflected goes through.
  const Vec3 through = tint * ((1.0F - chance) * multiple_scattering_gain(wo.z, alpha, Vec3(1.0F)).x);
  return {through * (pair.density * pair.shadowing), pair.density * (1.0F - chance)};
}

BsdfSample ThinTransmissionBsdf::sample(const Vec3& wo, float u_lobe, const Vec2& u) const {
  const float chance = reflectance(wo);
  const bool reflected = u_lobe < chance;
  Vec3 wi = sample_mirror(wo, alpha, u);
  if (wi.z <= 0.0F) return {};
  if (!reflected) wi.z = -wi.z;
  if (is_delta()) {
    return {.wi = wi, .weight = reflected ? Vec3(1.0F) : tint, .pdf = reflected ? chance : 1.0F - chance, .is_delta = true};
  }
  const BsdfValue value = evaluate(wo, wi);
  if (!(value.pdf > 0.0F)) return {};
  return {.wi = wi, .weight = value.value / value.pdf, .pdf = value.pdf};
}

Vec3 ThinTransmissionBsdf::albedo(const Vec3& wo) const {
  const float r = reflectance(wo);
  return Vec3(r) + (1.0F - r) * tint;
}

}  // namespace grove
