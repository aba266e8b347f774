#include "grove/scene/formats/mtl.h"

#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <utility>
#include <vector>

#include "grove/base/error.h"
#include "grove/scene/formats/text.h"
#include "grove/scene/read_file.h"
#include "grove/scene/read_image.h"

namespace grove {
namespace {

enum class ColourEncoding { srgb, linear };

Vec3 colour(const float (&rgb)[3]) {
  Vec3 result(0.0F);
  for (int i = 0; i < 3; ++i) {
    if (rgb[i] > 0.0F && std::isfinite(rgb[i])) result[i] = rgb[i];
  }
  return result;
}

float largest(const Vec3& v) {
  return std::fmax(v.x, std::fmax(v.y, v.z));
}

// A number in [low, high], low where it is none.
float within(float value, float low, float high) {
  return value > low ? (value < high ? value : high) : low;
}

class MaterialMaker {
 public:
  MaterialMaker(const std::filesystem::path& folder, Scene& scene) : folder_(folder), scene_(scene) {}

  Material make(const tinyobj::material_t& mtl) {
    Material material;
    material.name = mtl.name;
    material.base_colour.value = colour(mtl.diffuse);
    material.base_colour.texture = texture(mtl.diffuse_texname, mtl.diffuse_texopt, ColourEncoding::srgb);
    material.emission.value = colour(mtl.emission);
    material.emission.texture = texture(mtl.emissive_texname, mtl.emissive_texopt, ColourEncoding::srgb);
    if (material.emission.texture != kNoTexture && !material.is_emissive()) material.emission.value = Vec3(1.0F);
    material.normal_texture = texture(mtl.normal_texname, mtl.normal_texopt, ColourEncoding::linear);
    if (!mtl.bump_texname.empty() || !mtl.displacement_texname.empty()) {
      scene_.warn("bump and displacement maps of the material library are left out: their height has no unit");
    }
    set_surface(mtl, material);
    set_alpha(mtl, material);
    return material;
  }

 private:
  void set_surface(const tinyobj::material_t& mtl, Material& material) {
    const Vec3 specular = colour(mtl.specular);
    const bool glass_model = mtl.illum == 4 || mtl.illum == 6 || mtl.illum == 7 || mtl.illum == 9;
    const bool mirror_model = mtl.illum == 3 || mtl.illum == 5 || mtl.illum == 8;
    const Vec3 filter = colour(mtl.transmittance);
    if (mtl.roughness > 0.0F || mtl.metallic > 0.0F || !mtl.roughness_texname.empty() || !mtl.metallic_texname.empty()) {
      set_metallic_roughness(mtl, material);
    } else if (glass_model && (mtl.dissolve < 1.0F || largest(filter) > 0.0F)) {
      set_glass(mtl, filter, material);
    } else if (mirror_model && largest(specular) > largest(material.base_colour.value)) {
      material.base_colour = {.value = glm::min(specular, Vec3(1.0F)), .texture = kNoTexture};
      material.metallic.value = 1.0F;
      material.roughness.value = roughness_of_exponent(mtl.shininess);
    } else if (largest(specular) > 0.0F) {
      material.roughness.value = roughness_of_exponent(mtl.shininess);
    } else {
      material.kind = MaterialKind::diffuse;
    }
  }

  void set_metallic_roughness(const tinyobj::material_t& mtl, Material& material) {
    material.roughness.texture = texture(mtl.roughness_texname, mtl.roughness_texopt, ColourEncoding::linear);
    material.metallic.texture = texture(mtl.metallic_texname, mtl.metallic_texopt, ColourEncoding::linear);
    // A map without its factor is meant to be used as it is.
    material.roughness.value = material.roughness.texture != kNoTexture && mtl.roughness <= 0.0F ? 1.0F : within(mtl.roughness, 0, 1);
    material.metallic.value = material.metallic.texture != kNoTexture && mtl.metallic <= 0.0F ? 1.0F : within(mtl.metallic, 0, 1);
  }

  static void set_glass(const tinyobj::material_t& mtl, const Vec3& filter, Material& material) {
    material.ior = mtl.ior > 1.0F && mtl.ior < 10.0F ? mtl.ior : 1.5F;
    material.roughness.value = 0.0F;
    const bool colourless = filter.x == filter.y && filter.y == filter.z;
    if (colourless) {
      material.kind = MaterialKind::dielectric;
      return;
    }
    material.base_colour = {.value = glm::min(filter, Vec3(1.0F)), .texture = kNoTexture};
    material.transmission.value = 1.0F;
    material.thin_walled = false;
  }

  void set_alpha(const tinyobj::material_t& mtl, Material& material) {
    if (material.kind == MaterialKind::dielectric || material.transmission.value > 0.0F) return;
    material.alpha.texture = texture(mtl.alpha_texname, mtl.alpha_texopt, ColourEncoding::linear);
    material.alpha.value = within(mtl.dissolve, 0.0F, 1.0F);
    if (material.alpha.texture != kNoTexture) {
      const std::uint32_t channels = scene_.images[scene_.textures[material.alpha.texture].image]->channels;
      material.alpha.channel = channels == 4 || channels == 2 ? 3 : 0;
    }
    if (material.alpha.texture != kNoTexture || material.alpha.value < 1.0F) material.alpha_mode = AlphaMode::blend;
  }

  static float roughness_of_exponent(float ns) { return std::pow(2.0F / (within(ns, 0.0F, 1e6F) + 2.0F), 0.25F); }

  std::uint32_t texture(std::string name, const tinyobj::texture_option_t& options, ColourEncoding encoding) {
    if (name.empty()) return kNoTexture;
    std::replace(name.begin(), name.end(), '\\', '/');
    const std::uint32_t image_id = image(name);
    if (image_id == kNoTexture) return kNoTexture;
    Texture texture;
    texture.name = name;
    texture.kind = TextureKind::image;
    texture.image = image_id;
    texture.srgb = encoding == ColourEncoding::srgb;
    if (options.clamp) texture.wrap_u = texture.wrap_v = TextureWrap::clamp;
    // -s and -o first, then v is turned over, because row 0 is the top: (u, v) -> (su u + ou, 1 - (sv v + ov)).
    texture.uv_transform = Mat3(Vec3(options.scale[0], 0.0F, 0.0F), Vec3(0.0F, -options.scale[1], 0.0F),
                                Vec3(options.origin_offset[0], 1.0F - options.origin_offset[1], 1.0F));
    scene_.textures.push_back(std::move(texture));
    return static_cast<std::uint32_t>(scene_.textures.size() - 1);
  }

  // Each file is read once; kNoTexture when it cannot be.
  std::uint32_t image(const std::string& name) {
    const auto known = image_ids_.find(name);
    if (known != image_ids_.end()) return known->second;
    std::uint32_t id = kNoTexture;
    try {
      scene_.images.push_back(std::make_shared<const Image>(read_image(folder_ / name)));
      id = static_cast<std::uint32_t>(scene_.images.size() - 1);
    } catch (const InputError& error) {
      scene_.warn(std::string("a texture is left out: ") + error.what());
    }
    image_ids_.emplace(name, id);
    return id;
  }

  std::filesystem::path folder_;
  Scene& scene_;
  std::map<std::string, std::uint32_t> image_ids_;
};

}  // namespace

void load_mtl(const std::filesystem::path& file, Scene& scene, std::map<std::string, std::uint32_t>& ids) {
  const std::vector<std::byte> bytes = read_file(file);
  std::istringstream text(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  std::map<std::string, int> unused;
  std::vector<tinyobj::material_t> materials;
  std::string warnings;
  std::string errors;
  tinyobj::LoadMtl(&unused, &materials, &text, &warnings, &errors);
  MaterialMaker maker(file.parent_path(), scene);
  for (const tinyobj::material_t& mtl : materials) {
    if (mtl.name.empty() || !ids.try_emplace(mtl.name, static_cast<std::uint32_t>(scene.materials.size())).second) continue;
    scene.materials.push_back(maker.make(mtl));
  }
}

}  // namespace grove
