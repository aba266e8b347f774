#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "grove/scene/pbrt/parameters.h"
#include "grove/scene/pbrt/transforms.h"

namespace grove::pbrt {

inline constexpr std::uint32_t kNone = 0xffffffffU;

/// A Material or MakeNamedMaterial directive. `later_name` is set instead where a NamedMaterial directive named one that was not there yet.
struct MaterialDirective {
  std::string name;  ///< empty for Material
  std::string type;
  ParameterList parameters;
  std::string later_name;
};

struct TextureDirective {
  std::string name;
  bool is_spectrum = false;  ///< otherwise of floats
  std::string type;
  ParameterList parameters;
};

struct LightDirective {
  std::string type;
  ParameterList parameters;
  Matrix to_world{1.0};
};

struct AreaLightDirective {
  std::string type;
  ParameterList parameters;
};

struct ShapeDirective {
  std::string type;
  ParameterList parameters;
  Matrix to_world{1.0};  ///< inside an object definition: to the space of the definition
  bool reverse_orientation = false;
  std::uint32_t material = 0;        ///< index into Description::materials
  std::uint32_t area_light = kNone;  ///< index into Description::area_lights
};

struct ObjectDefinition {
  std::string name;
  std::vector<ShapeDirective> shapes;
};

struct ObjectUse {
  std::string name;
  Place place;
  Matrix to_world{1.0};
};

struct CameraDirective {
  std::string type;
  ParameterList parameters;
  Matrix world_to_camera{1.0};
};

/// What the directives of a scene say, in their order, with transforms and attributes resolved; nothing is built yet.
struct Description {
  std::optional<CameraDirective> camera;
  std::optional<ParameterList> film;
  std::vector<MaterialDirective> materials;  ///< the first is the default
  std::map<std::string, std::uint32_t, std::less<>> named_materials;
  std::vector<TextureDirective> textures;
  std::vector<LightDirective> lights;
  std::vector<AreaLightDirective> area_lights;
  std::vector<ShapeDirective> shapes;  ///< outside object definitions
  std::vector<ObjectDefinition> objects;
  std::vector<ObjectUse> uses;
};

}  // namespace grove::pbrt
