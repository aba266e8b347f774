#include "grove/render/bsdf/layered.h"
#include "grove/render/sampling/warp.h"

namespace grove {

Vec3 MetallicRoughnessBsdf::f0() const {
  return Vec3(dielectric_f0) * (1.0F - metallic) + base_colour * metallic;
}

float MetallicRoughnessBsdf::dielectric_albedo(float cosine) const {
  if (alpha < kSmoothAlpha) return dielectric_f0 + (1.0F - dielectric_f0) * schlick_weight(cosine);
  const GgxAlbedo& table = ggx_albedo();
  const float scale = table.scale(cosine, alpha);
  const float bias = table.bias(cosine, alpha);
  const float single = scale + bias;
  return std::min(1.0F, (dielectric_f0 * scale + bias) * (1.0F + dielectric_f0 * (1.0F - single) / single));
}

Vec3 MetallicRoughnessBsdf::diffuse(float cosine_o, float cosine_i) const {
  const GgxAlbedo& table = ggx_albedo();
  const float width = alpha < kSmoothAlpha ? 0.0F : alpha;
  const float mean = table.mean_constant(width) + dielectric_f0 * (table.mean_linear(width) + dielectric_f0 * table.mean_quadratic(width));
  const float coupling = (1.0F - dielectric_albedo(cosine_o)) * (1.0F - dielectric_albedo(cosine_i)) / std::max(1e-3F, 1.0F - mean);
  return base_colour * ((1.0F - metallic) * coupling / kPi);
}

float MetallicRoughnessBsdf::mirror_chance(const Vec3& wo) const {
  // The mirror lobe's albedo as though it were smooth: near enough for a choice.
  const float mirror = max_component(fresnel_schlick(wo.z, f0()));
  return lobe_chance(mirror, (1.0F - metallic) * max_component(base_colour) * (1.0F - dielectric_albedo(wo.z)));
}

BsdfValue MetallicRoughnessBsdf::evaluate(const Vec3& wo, const Vec3& wi) const {
  if (wi.z <= 0.0F) return {};
  const float chance = mirror_chance(wo);
  BsdfValue result{diffuse(wo.z, wi.z) * wi.z, (1.0F - chance) * wi.z / kPi};
  if (alpha >= kSmoothAlpha) {
    const MirrorPair pair = mirror_pair(wo, wi, alpha);
    const Vec3 normal_reflectance = f0();
    const Vec3 gain = multiple_scattering_gain(wo.z, alpha, normal_reflectance);
    result.value += fresnel_schlick(pair.facet_cosine, normal_reflectance) * gain * (pair.density * pair.shadowing);
    result.pdf += chance * pair.density;
  }
  return result;
}

BsdfSample MetallicRoughnessBsdf::sample(const Vec3& wo, float u_lobe, const Vec2& u) const {
  const float chance = mirror_chance(wo);
  Vec3 wi;
  if (u_lobe < chance) {
    wi = sample_mirror(wo, alpha, u);
    if (alpha < kSmoothAlpha) return {.wi = wi, .weight = fresnel_schlick(wo.z, f0()) / chance, .pdf = chance, .is_delta = true};
  } else {
    wi = sample_cosine_hemisphere(u);
  }
  const BsdfValue value = evaluate(wo, wi);
  if (!(value.pdf > 0.0F)) return {};
  return {.wi = wi, .weight = value.value / value.pdf, .pdf = value.pdf};
}

Vec3 MetallicRoughnessBsdf::albedo(const Vec3& wo) const {
  const float mirror = dielectric_albedo(wo.z);
  return base_colour * metallic + (Vec3(mirror) + base_colour * (1.0F - mirror)) * (1.0F - metallic);
}

}  // namespace grove
