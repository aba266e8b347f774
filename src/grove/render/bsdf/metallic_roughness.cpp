#include "grove/render/bsdf/layered.h"
#include "grove/render/sampling/warp.h"

namespace grove {

GlossyLayer MetallicRoughnessBsdf::mirror() const {
  return {.f0 = glm::mix(dielectric_f0, base_colour, metallic), .f90 = dielectric_f90 + (1.0F - dielectric_f90) * metallic, .alpha = alpha};
}

float MetallicRoughnessBsdf::dielectric_albedo(float cosine) const {
  return max_component(GlossyLayer{.f0 = dielectric_f0, .f90 = dielectric_f90, .alpha = alpha}.albedo(cosine));
}

Vec3 MetallicRoughnessBsdf::diffuse(float cosine_o, float cosine_i) const {
  const GgxAlbedo& table = ggx_albedo();
  const float width = alpha < kSmoothAlpha ? 0.0F : alpha;
  const float f0 = max_component(dielectric_f0);
  const float mean = dielectric_f90 * table.mean_bias(width) +
                     f0 * (table.mean_scale(width) + dielectric_f90 * table.mean_bias_gain(width) + f0 * table.mean_scale_gain(width));
  const float coupling = (1.0F - dielectric_albedo(cosine_o)) * (1.0F - dielectric_albedo(cosine_i)) / std::max(1e-3F, 1.0F - mean);
  return base_colour * ((1.0F - metallic) * coupling / kPi);
}

float MetallicRoughnessBsdf::mirror_chance(const Vec3& wo) const {
  // The mirror lobe's albedo as though it were smooth: near enough for a choice.
  return lobe_chance(max_component(mirror().fresnel(wo.z)),
                     (1.0F - metallic) * max_component(base_colour) * (1.0F - dielectric_albedo(wo.z)));
}

BsdfValue MetallicRoughnessBsdf::evaluate(const Vec3& wo, const Vec3& wi) const {
  if (wi.z <= 0.0F) return {};
  const float chance = mirror_chance(wo);
  const BsdfValue reflected = mirror().evaluate(wo, wi);
  return {diffuse(wo.z, wi.z) * wi.z + reflected.value, (1.0F - chance) * wi.z / kPi + chance * reflected.pdf};
}

BsdfSample MetallicRoughnessBsdf::sample(const Vec3& wo, float u_lobe, const Vec2& u) const {
  const float chance = mirror_chance(wo);
  Vec3 wi;
  if (u_lobe < chance) {
    wi = sample_mirror(wo, alpha, u);
    if (alpha < kSmoothAlpha) return {.wi = wi, .weight = mirror().fresnel(wo.z) / chance, .pdf = chance, .is_delta = true};
  } else {
    wi = sample_cosine_hemisphere(u);
  }
  const BsdfValue value = evaluate(wo, wi);
  if (!(value.pdf > 0.0F)) return {};
  return {.wi = wi, .weight = value.value / value.pdf, .pdf = value.pdf};
}

Vec3 MetallicRoughnessBsdf::albedo(const Vec3& wo) const {
  const Vec3 dielectric = GlossyLayer{.f0 = dielectric_f0, .f90 = dielectric_f90, .alpha = alpha}.albedo(wo.z);
  return base_colour * metallic + (dielectric + base_colour * (1.0F - max_component(dielectric))) * (1.0F - metallic);
}

}  // namespace grove
