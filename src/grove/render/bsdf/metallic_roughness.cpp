#include "grove/render/bsdf/layered.h"
#include "grove/render/sampling/warp.h"

namespace grove {

GlossyLayer MetallicRoughnessBsdf::mirror() const {
  return {.f0 = glm::mix(dielectric_f0, base_colour, metallic), .f90 = dielectric_f90 + (1.0F - dielectric_f90) * metallic, .alpha = alpha};
}

float MetallicRoughnessBsdf::dielectric_albedo(float cosine) const {
  return max_component(GlossyLayer{.f0 = dielectric_f0, .f90 = dielectric_f90, .alpha = alpha}.albedo(cosine));
}

// `albedo_o` is the dielectric's for wo.
Vec3 MetallicRoughnessBsdf::diffuse(float albedo_o, float cosine_i) const {
  const float mean = ggx_albedo().mean(max_component(dielectric_f0), dielectric_f90, alpha < kSmoothAlpha ? 0.0F : alpha);
  const float coupling = (1.0F - albedo_o) * (1.0F - dielectric_albedo(cosine_i)) / std::max(1e-3F, 1.0F - mean);
  return base_colour * ((1.0F - metallic) * coupling / kPi);
}

MetallicRoughnessBsdf::View MetallicRoughnessBsdf::view(const Vec3& wo) const {
  View result{mirror(), dielectric_albedo(wo.z), 0.0F};
  // The mirror lobe's albedo as though it were smooth: near enough for a choice.
  result.mirror_chance = lobe_chance(max_component(result.mirror.fresnel(wo.z)),
                                     (1.0F - metallic) * max_component(base_colour) * (1.0F - result.dielectric_albedo));
  return result;
}

BsdfValue MetallicRoughnessBsdf::evaluate(const View& view, const Vec3& wo, const Vec3& wi) const {
  if (wi.z <= 0.0F) return {};
  const BsdfValue reflected = view.mirror.evaluate(wo, wi);
  return {diffuse(view.dielectric_albedo, wi.z) * wi.z + reflected.value,
          (1.0F - view.mirror_chance) * wi.z / kPi + view.mirror_chance * reflected.pdf};
}

BsdfValue MetallicRoughnessBsdf::evaluate(const Vec3& wo, const Vec3& wi) const {
  return wi.z <= 0.0F ? BsdfValue{} : evaluate(view(wo), wo, wi);
}

BsdfSample MetallicRoughnessBsdf::sample(const Vec3& wo, float u_lobe, const Vec2& u) const {
  const View view = this->view(wo);
  const float chance = view.mirror_chance;
  Vec3 wi;
  if (u_lobe < chance) {
    wi = sample_mirror(wo, alpha, u);
    if (alpha < kSmoothAlpha) return {.wi = wi, .weight = view.mirror.fresnel(wo.z) / chance, .pdf = chance, .is_delta = true};
  } else {
    wi = sample_cosine_hemisphere(u);
  }
  const BsdfValue value = evaluate(view, wo, wi);
  if (!(value.pdf > 0.0F)) return {};
  return {.wi = wi, .weight = value.value / value.pdf, .pdf = value.pdf};
}

Vec3 MetallicRoughnessBsdf::albedo(const Vec3& wo) const {
  const Vec3 dielectric = GlossyLayer{.f0 = dielectric_f0, .f90 = dielectric_f90, .alpha = alpha}.albedo(wo.z);
  return base_colour * metallic + (dielectric + base_colour * (1.0F - max_component(dielectric))) * (1.0F - metallic);
}

}  // namespace grove
