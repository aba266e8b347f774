#include "grove/render/material/gltf_surface.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "grove/render/surface/perturb_normal.h"
#include "grove/render/texture/evaluate_texture.h"

namespace grove {
namespace {

constexpr float kMinIor = 0.1F;
constexpr float kMaxIor = 10.0F;

float unit(float value) {
  return value > 0.0F ? std::min(value, 1.0F) : 0.0F;
}

// The values of a material's parameters at one place.
class Parameters {
 public:
  Parameters(const Scene& scene, const SurfacePoint& point) : scene_(scene), uv_(point.coordinates()) {}

  [[nodiscard]] float number(const ScalarParameter& parameter) const {
    return parameter.value > 0.0F ? unit(evaluate(scene_, parameter, uv_)) : 0.0F;
  }
  // The same of two that mostly share a texture, which is then looked up once.
  [[nodiscard]] Vec2 numbers(const ScalarParameter& a, const ScalarParameter& b) const {
    if (a.texture == kNoTexture || a.texture != b.texture) return {number(a), number(b)};
    const Vec4 both = evaluate_texture(scene_, a.texture, uv_);
    return {unit(a.value * channel(both, a)), unit(b.value * channel(both, b))};
  }
  // The colour of what is reflected; above 1 it would make light from nothing.
  [[nodiscard]] Vec3 reflectance(const ColourParameter& parameter) const {
    return glm::clamp(evaluate(scene_, parameter, uv_), Vec3(0.0F), Vec3(1.0F));
  }
  [[nodiscard]] Vec3 factor(const ColourParameter& parameter) const { return glm::max(evaluate(scene_, parameter, uv_), Vec3(0.0F)); }
  [[nodiscard]] float alpha(const ScalarParameter& roughness) const {
    const float perceptual = number(roughness);
    return perceptual * perceptual;
  }

 private:
  static float channel(const Vec4& value, const ScalarParameter& parameter) {
    return value[static_cast<int>(std::min(parameter.channel, 3U))];
  }

  const Scene& scene_;
  TextureCoordinates uv_;
};

GltfLayersBsdf::Core core_of(const Material& material, const SurfacePoint& point, const Parameters& at, bool is_outside,
                             const DielectricAlbedo* table, float u) {
  const Vec3 colour = glm::clamp(at.factor(material.base_colour) * Vec3(point.colour), Vec3(0.0F), Vec3(1.0F));
  const Vec2 numbers = at.numbers(material.roughness, material.metallic);
  const float alpha = numbers.x * numbers.x;
  const float metallic = numbers.y;
  const float ior = usable_ior(material.ior);
  const float specular = at.number(material.specular);
  const Vec3 specular_colour = at.factor(material.specular_colour);
  // Where nothing is refracted, an index may be as high as it likes: one of 0 stands for infinity (KHR_materials_ior).
  const float root = (std::max(kMinIor, material.ior) - 1.0F) / (std::max(kMinIor, material.ior) + 1.0F);
  const float f0 = root * root;
  const Vec3 coloured_f0 = specular * glm::min(f0 * specular_colour, Vec3(1.0F));
  // The transmissive part of the dielectric part, as a share of the whole; what is left is the same material without transmission.
  const float share = at.number(material.transmission) * (1.0F - metallic);
  if (u < share) {
    if (material.thin_walled) return ThinTransmissionBsdf{.tint = colour, .mirror = {.f0 = coloured_f0, .f90 = specular, .alpha = alpha}};
    return DielectricBsdf{.eta = is_outside ? ior : 1.0F / ior,
                          .alpha = alpha,
                          .albedo_table = table,
                          .tint = colour,
                          .factors = {.weight = specular, .tint = specular_colour}};
  }
  const float rest = share < 1.0F ? std::min(1.0F, metallic / (1.0F - share)) : 0.0F;
  return MetallicRoughnessBsdf{
      .base_colour = colour, .metallic = rest, .alpha = alpha, .dielectric_f0 = coloured_f0, .dielectric_f90 = specular};
}

// In the viewer's frame; turned where the viewer would not see it.
Vec3 local_coat_normal(const Vec3& normal, const SurfaceView& view) {
  constexpr float kLeastCosine = 0.01F;
  const Vec3 local = view.frame.to_local(view.is_outside ? normal : -normal);
  return glm::dot(local, view.wo) > kLeastCosine ? local : Vec3(0.0F, 0.0F, 1.0F);
}

// Light that leaves a volume is refracted there and not coated from within.
bool is_inside_volume(const Material& material, bool is_outside) {
  return !is_outside && !material.thin_walled && material.transmission.value > 0.0F;
}

}  // namespace

float coat_transmittance(const Scene& scene, const Material& material, const SurfacePoint& point, const Vec3& direction) {
  if (material.kind != MaterialKind::metallic_roughness) return 1.0F;
  if (is_inside_volume(material, glm::dot(direction, point.geometric_normal) >= 0.0F)) return 1.0F;
  const Parameters at(scene, point);
  const float weight = at.number(material.coat);
  if (!(weight > 0.0F)) return 1.0F;
  const float cosine = std::min(1.0F, std::fabs(glm::dot(direction, coat_normal(scene, material, point))));
  return 1.0F - weight * GlossyLayer{.alpha = at.alpha(material.coat_roughness)}.albedo(cosine).x;
}

float usable_ior(float ior) {
  return ior > 0.0F ? std::clamp(ior, kMinIor, kMaxIor) : 1.0F;
}

Bsdf gltf_bsdf(const Scene& scene, const Material& material, const SurfacePoint& point, const SurfaceView& view,
               const DielectricAlbedo* table, float u) {
  const Parameters at(scene, point);
  GltfLayersBsdf result{.core = core_of(material, point, at, view.is_outside, table, u)};
  if (!is_inside_volume(material, view.is_outside)) {
    const Vec3 sheen = material.sheen_colour.value == Vec3(0.0F) ? Vec3(0.0F) : at.reflectance(material.sheen_colour);
    if (max_component(sheen) > 0.0F)
      result.sheen = {.colour = sheen, .alpha = std::max(kLeastSheenAlpha, at.alpha(material.sheen_roughness))};
    result.coat_weight = at.number(material.coat);
  }
  if (result.coat_weight > 0.0F) {
    result.coat.alpha = at.alpha(material.coat_roughness);
    result.coat_normal = local_coat_normal(coat_normal(scene, material, point), view);
  }
  if (result.coat_weight > 0.0F || result.sheen.exists()) return result;
  return std::visit([](const auto& core) { return Bsdf(core); }, result.core);
}

}  // namespace grove
