#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "grove/scene/pbrt/texture_builder.h"

namespace grove::pbrt {

/// Turns Material directives, with the area light and the alpha of the shapes that wear them, into Scene::materials.
/// Only materials that shapes wear are made.
class MaterialBuilder {
 public:
  MaterialBuilder(const Description& description, TextureBuilder& textures, Scene& scene, Context& context)
      : description_(description), textures_(textures), scene_(scene), context_(context), built_(description.materials.size(), kNone) {}

  /// The material of a shape: index into Scene::materials.
  std::uint32_t material_of(const ShapeDirective& shape);
  /// Whether it, or one that it mixes, looks at texture coordinates.
  [[nodiscard]] bool is_textured(std::uint32_t material) const { return textured_[material]; }

 private:
  std::uint32_t build(std::uint32_t id);
  std::uint32_t add(Material m);
  Material make(const MaterialDirective& directive);
  void make_diffuse(Material& m, const ParameterList& p);
  void make_coated_diffuse(Material& m, const ParameterList& p);
  void make_conductor(Material& m, const ParameterList& p, const std::string& prefix);
  void make_coated_conductor(Material& m, const ParameterList& p);
  void make_dielectric(Material& m, const ParameterList& p);
  void make_diffuse_transmission(Material& m, const ParameterList& p);
  void make_mix(Material& m, const ParameterList& p);
  void make_hair(Material& m, const ParameterList& p);
  void make_stand_in(Material& m, const MaterialDirective& directive);
  /// What every material may have: a normal map and a bump map.
  void add_relief(Material& m, const ParameterList& p);
  /// pbrt's roughness under `prefix` ("interface." for example) as ours.
  ScalarParameter roughness(const ParameterList& p, const std::string& prefix, float otherwise);
  void ignore_layer(const ParameterList& p);
  void add_emission(Material& m, const AreaLightDirective& light);
  void add_alpha(Material& m, const ShapeDirective& shape);
  std::uint32_t named(const std::string& name, const Place& place);

  const Description& description_;
  TextureBuilder& textures_;
  Scene& scene_;
  Context& context_;
  std::vector<std::uint32_t> built_;  // per directive
  std::uint32_t depth_ = 0;           // of mixes within mixes that are being built
  // Per material of the scene: levels of mixes, and whether it looks at texture coordinates.
  std::vector<std::uint32_t> heights_;
  std::vector<bool> textured_;
  // (base material, area light, alpha texture, alpha value): variants of a material for shapes that emit or are cut out.
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::string, float>, std::uint32_t> variants_;
};

}  // namespace grove::pbrt
