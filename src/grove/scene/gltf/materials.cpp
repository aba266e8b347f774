#include "grove/scene/gltf/materials.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "grove/scene/gltf/textures.h"

namespace grove {
namespace {

// glTF packs roughness into green and metallic into blue of one texture; what is on its own stands in red, or in alpha beside a colour.
constexpr std::uint32_t kRoughnessChannel = 1;
constexpr std::uint32_t kMetallicChannel = 2;
constexpr std::uint32_t kOwnChannel = 0;
constexpr std::uint32_t kAlphaChannel = 3;

float clamp_unit(float value) {
  return value > 0.0F ? std::min(value, 1.0F) : 0.0F;
}

Vec3 clamp_positive(const Vec3& value) {
  return {value.x > 0.0F ? value.x : 0.0F, value.y > 0.0F ? value.y : 0.0F, value.z > 0.0F ? value.z : 0.0F};
}

// The weights and the root of squares are those of the conversion guide that comes with KHR_materials_pbrSpecularGlossiness.
float perceived_brightness(const Vec3& colour) {
  return std::sqrt(0.299F * colour.x * colour.x + 0.587F * colour.y * colour.y + 0.114F * colour.z * colour.z);
}

// The metallic value m at which a surface of one base colour c reflects as brightly as the given diffuse and specular colours do:
// diffuse = c (1 - s) (1 - m) / (1 - strength) and specular = s (1 - m) + c m, with s = 0.04, solved for m without c: a quadratic.
float metallic_from(float diffuse, float specular, float one_minus_strength) {
  constexpr float kDielectric = 0.04F;
  if (specular < kDielectric) return 0.0F;
  const float a = kDielectric;
  const float b = diffuse * one_minus_strength / (1.0F - kDielectric) + specular - 2.0F * kDielectric;
  const float c = kDielectric - specular;
  return clamp_unit((-b + std::sqrt(std::max(b * b - 4.0F * a * c, 0.0F))) / (2.0F * a));
}

class MaterialReader {
 public:
  MaterialReader(GltfDocument& document, Scene& scene) : document_(document), scene_(scene), textures_(document, scene) {}

  Material read(const JsonCursor& source) {
    Material material;
    material.name = source["name"].text();
    const JsonCursor specular_glossiness = source.extension("KHR_materials_pbrSpecularGlossiness");
    if (specular_glossiness.exists()) {
      read_specular_glossiness(specular_glossiness, material);
    } else {
      read_metallic_roughness(source["pbrMetallicRoughness"], material);
    }
    read_normal(source["normalTexture"], material);
    read_alpha(source, material);
    read_emission(source, material);
    read_transmission(source, material);
    read_volume(source.extension("KHR_materials_volume"), material);
    read_specular(source.extension("KHR_materials_specular"), material);
    read_coat(source.extension("KHR_materials_clearcoat"), material);
    read_sheen(source.extension("KHR_materials_sheen"), material);
    if (source.extension("KHR_materials_unlit").exists()) make_unlit(material);
    return material;
  }

 private:
  void warn(std::string line, const std::string& kind) {
    if (document_.is_first(kind)) scene_.warn(std::move(line));
  }

  void set_base_colour(const JsonCursor& factor, const JsonCursor& texture, Material& material) {
    const Vec4 colour = factor.vec4(Vec4(1.0F));
    material.base_colour.value = clamp_positive(Vec3(colour));
    material.base_colour.texture = textures_.add(texture, TextureUse::colour);
    material.alpha.value = clamp_unit(colour.w);
    material.alpha.texture = material.base_colour.texture;
  }

  void read_metallic_roughness(const JsonCursor& source, Material& material) {
    set_base_colour(source["baseColorFactor"], source["baseColorTexture"], material);
    const std::uint32_t texture = textures_.add(source["metallicRoughnessTexture"], TextureUse::data);
    material.metallic = {clamp_unit(source["metallicFactor"].real(1.0F)), texture, kMetallicChannel};
    material.roughness = {clamp_unit(source["roughnessFactor"].real(1.0F)), texture, kRoughnessChannel};
  }

  void read_specular_glossiness(const JsonCursor& source, Material& material) {
    warn("KHR_materials_pbrSpecularGlossiness is turned into metallic and roughness approximately, such as " + source.path(), "specular");
    set_base_colour(source["diffuseFactor"], source["diffuseTexture"], material);
    const Vec3 specular = clamp_positive(source["specularFactor"].vec3(Vec3(1.0F)));
    const Vec3 diffuse = material.base_colour.value;
    const float strength = clamp_unit(std::max({specular.x, specular.y, specular.z}));
    // A texture of specular colours would need converting pixel by pixel; where there is one, the surface is taken to be a dielectric.
    const float metallic = source["specularGlossinessTexture"].exists()
                               ? 0.0F
                               : metallic_from(perceived_brightness(diffuse), perceived_brightness(specular), 1.0F - strength);
    material.metallic.value = metallic;
    material.roughness.value = 1.0F - clamp_unit(source["glossinessFactor"].real(1.0F));
    material.base_colour.value = glm::mix(diffuse, specular, metallic * metallic);
  }

  void read_normal(const JsonCursor& source, Material& material) {
    material.normal_texture = textures_.add(source, TextureUse::data);
    material.normal_scale = source["scale"].real(1.0F);
  }

  void read_alpha(const JsonCursor& source, Material& material) {
    const std::string mode = source["alphaMode"].text("OPAQUE");
    if (mode == "MASK") {
      material.alpha_mode = AlphaMode::mask;
    } else if (mode == "BLEND") {
      material.alpha_mode = AlphaMode::blend;
    } else if (mode != "OPAQUE") {
      source["alphaMode"].fail("is none of OPAQUE, MASK and BLEND");
    }
    material.alpha_cutoff = source["alphaCutoff"].real(0.5F);
  }

  void read_emission(const JsonCursor& source, Material& material) {
    const float strength = source.extension("KHR_materials_emissive_strength")["emissiveStrength"].real(1.0F);
    material.emission.value = clamp_positive(source["emissiveFactor"].vec3(Vec3(0.0F)) * strength);
    // With a factor of 0 the texture has nothing to scale.
    if (material.is_emissive()) material.emission.texture = textures_.add(source["emissiveTexture"], TextureUse::colour);
    // The back of a single-sided surface is not drawn, and so does not shine.
    material.two_sided_emission = source["doubleSided"].boolean(false);
  }

  [[nodiscard]] ScalarParameter read_scalar(const JsonCursor& extension, const char* factor, const char* texture, float fallback,
                                            std::uint32_t channel) {
    const float value = clamp_unit(extension[factor].real(fallback));
    return {value, value > 0.0F ? textures_.add(extension[texture], TextureUse::data) : kNoTexture, channel};
  }

  [[nodiscard]] ColourParameter read_colour(const JsonCursor& extension, const char* factor, const char* texture, const Vec3& fallback) {
    const Vec3 value = clamp_positive(extension[factor].vec3(fallback));
    return {value, value != Vec3(0.0F) ? textures_.add(extension[texture], TextureUse::colour) : kNoTexture};
  }

  void read_transmission(const JsonCursor& source, Material& material) {
    const float ior = source.extension("KHR_materials_ior")["ior"].real(1.5F);
    // 0 is the extension's way to say infinite, for converted specular materials; 1e3 reflects 99.6 % already.
    material.ior = ior > 0.0F ? std::clamp(ior, 1.0F, 1e3F) : 1e3F;
    const JsonCursor transmission = source.extension("KHR_materials_transmission");
    material.transmission = {clamp_unit(transmission["transmissionFactor"].real(0.0F)),
                             textures_.add(transmission["transmissionTexture"], TextureUse::data), kOwnChannel};
  }

  // Paths find out how thick a volume is, so that of the thickness only matters whether there is any.
  void read_volume(const JsonCursor& volume, Material& material) {
    material.thin_walled = !(volume["thicknessFactor"].real(0.0F) > 0.0F);
    const float distance = volume["attenuationDistance"].real(std::numeric_limits<float>::infinity());
    if (distance > 0.0F) {
      material.attenuation_distance = distance;
    } else {
      warn("KHR_materials_volume: an attenuation distance that is not above 0 is taken as infinite, such as in " + volume.path(),
           "attenuation");
    }
    material.attenuation_colour = glm::min(clamp_positive(volume["attenuationColor"].vec3(Vec3(1.0F))), Vec3(1.0F));
  }

  void read_specular(const JsonCursor& specular, Material& material) {
    material.specular = read_scalar(specular, "specularFactor", "specularTexture", 1.0F, kAlphaChannel);
    material.specular_colour = read_colour(specular, "specularColorFactor", "specularColorTexture", Vec3(1.0F));
  }

  void read_coat(const JsonCursor& coat, Material& material) {
    material.coat = read_scalar(coat, "clearcoatFactor", "clearcoatTexture", 0.0F, kOwnChannel);
    if (!(material.coat.value > 0.0F)) return;
    material.coat_roughness = read_scalar(coat, "clearcoatRoughnessFactor", "clearcoatRoughnessTexture", 0.0F, kRoughnessChannel);
    material.coat_normal_texture = textures_.add(coat["clearcoatNormalTexture"], TextureUse::data);
    material.coat_normal_scale = coat["clearcoatNormalTexture"]["scale"].real(1.0F);
  }

  void read_sheen(const JsonCursor& sheen, Material& material) {
    material.sheen_colour = read_colour(sheen, "sheenColorFactor", "sheenColorTexture", Vec3(0.0F));
    if (material.sheen_colour.value == Vec3(0.0F)) return;
    material.sheen_roughness = read_scalar(sheen, "sheenRoughnessFactor", "sheenRoughnessTexture", 0.0F, kAlphaChannel);
  }

  // The same radiance from all sides, whatever shines on the surface: it emits its base colour and scatters nothing.
  static void make_unlit(Material& material) {
    material.kind = MaterialKind::diffuse;
    material.emission = material.base_colour;
    material.emits_vertex_colour = true;
    material.two_sided_emission = true;
    material.base_colour = {.value = Vec3(0.0F)};
  }

  GltfDocument& document_;
  Scene& scene_;
  GltfTextures textures_;
};

}  // namespace

void read_materials(GltfDocument& document, Scene& scene) {
  MaterialReader reader(document, scene);
  const JsonCursor materials = document.array("materials");
  for (std::size_t i = 0; i < materials.size(); ++i) scene.materials.push_back(reader.read(materials.element(i)));
}

std::uint32_t default_material(const GltfDocument& document, Scene& scene) {
  const std::size_t id = document.array("materials").size();
  if (scene.materials.size() == id) {
    Material material;
    material.name = "default";
    material.metallic.value = 1.0F;
    scene.materials.push_back(std::move(material));
  }
  return static_cast<std::uint32_t>(id);
}

}  // namespace grove
