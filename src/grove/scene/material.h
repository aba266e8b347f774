#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "grove/math/vector.h"
#include "grove/scene/texture.h"

namespace grove {

/// A colour, times a texture where there is one.
struct ColourParameter {
  Vec3 value{1.0F};
  std::uint32_t texture = kNoTexture;
};

/// A number, times one channel of a texture where there is one.
struct ScalarParameter {
  float value = 1.0F;
  std::uint32_t texture = kNoTexture;
  std::uint32_t channel = 0;  ///< 0 red to 3 alpha
};

enum class MaterialKind : std::uint8_t {
  metallic_roughness,    ///< glTF 2.0: base colour, metallic, roughness, with transmission (KHR_materials_transmission) and ior
  diffuse,               ///< Lambert: base_colour
  coated_diffuse,        ///< Lambert under a dielectric layer of `roughness` and `ior`
  conductor,             ///< metal: `ior_colour` and `absorption`, or base_colour as reflectance at normal incidence; `roughness`
  coated_conductor,      ///< the same under a dielectric layer of `coat_roughness` and `ior`
  dielectric,            ///< glass or water: `ior`, `roughness`
  thin_dielectric,       ///< a pane: both faces in one, no bending of rays
  interface,             ///< nothing: rays pass (a boundary of media)
  diffuse_transmission,  ///< Lambert on both sides: base_colour reflected, transmission_colour transmitted
  mix                    ///< one of two materials, by `mix_amount`
};

enum class AlphaMode : std::uint8_t { opaque, mask, blend };

/// How a surface scatters and emits. Fields that a kind does not name are not read. All colours are linear RGB (Rec. 709 primaries).
struct Material {
  std::string name;
  MaterialKind kind = MaterialKind::metallic_roughness;

  ColourParameter base_colour;
  ScalarParameter metallic{.value = 0.0F};
  /// Perceptual: the GGX width is its square.
  ScalarParameter roughness{.value = 1.0F};
  ScalarParameter coat_roughness{.value = 0.0F};
  float ior = 1.5F;

  /// glTF: factors on what the dielectric part reflects: on all of it, and on what it reflects at normal incidence (KHR_materials_specular).
  ScalarParameter specular{.value = 1.0F, .texture = kNoTexture, .channel = 3};
  ColourParameter specular_colour;
  /// glTF: the part of the surface under a clear coat of index 1.5 and `coat_roughness`. The coat follows the vertex normals, whatever
  /// the normal map of the surface below, or a normal map of its own (KHR_materials_clearcoat).
  ScalarParameter coat{.value = 0.0F};
  std::uint32_t coat_normal_texture = kNoTexture;
  float coat_normal_scale = 1.0F;
  /// glTF: fibres that stand on the surface, as of velvet (KHR_materials_sheen). Perceptual roughness.
  ColourParameter sheen_colour{.value = Vec3(0.0F)};
  ScalarParameter sheen_roughness{.value = 0.0F, .texture = kNoTexture, .channel = 3};

  ColourParameter transmission_colour{.value = Vec3(0.0F)};
  ScalarParameter transmission{.value = 0.0F};  ///< glTF: the fraction of the dielectric part that is let through
  bool thin_walled = true;                      ///< glTF transmission without KHR_materials_volume: no refraction of the path
  /// glTF: what is left of white light after so many world units inside a surface that is not thin-walled (KHR_materials_volume).
  Vec3 attenuation_colour{1.0F};
  float attenuation_distance = std::numeric_limits<float>::infinity();

  bool has_complex_ior = false;  ///< conductor: use ior_colour and absorption rather than base_colour
  Vec3 ior_colour{0.0F};
  Vec3 absorption{0.0F};

  std::uint32_t normal_texture = kNoTexture;  ///< tangent space, linear
  float normal_scale = 1.0F;
  ScalarParameter bump{.value = 0.0F};  ///< height in world units (pbrt displacement); a texture is needed for an effect

  AlphaMode alpha_mode = AlphaMode::opaque;
  ScalarParameter alpha{.value = 1.0F, .texture = kNoTexture, .channel = 3};
  float alpha_cutoff = 0.5F;

  /// Radiance. One-sided emission leaves on the side of the geometric normal.
  ColourParameter emission{.value = Vec3(0.0F)};
  bool two_sided_emission = true;
  bool emits_vertex_colour = false;  ///< vertex colours multiply the emission, as on unlit surfaces

  std::uint32_t mix_material[2] = {0, 0};  ///< indices into Scene::materials, lower than this one's
  ScalarParameter mix_amount{.value = 0.5F};

  [[nodiscard]] bool is_emissive() const { return emission.value.x > 0.0F || emission.value.y > 0.0F || emission.value.z > 0.0F; }
};

}  // namespace grove
