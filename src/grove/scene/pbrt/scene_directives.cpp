#include <algorithm>
#include <utility>

#include "grove/scene/pbrt/directives.h"

namespace grove::pbrt {
namespace {

struct TargetName {
  std::string_view name;
  AttributeTarget target;
};

constexpr std::array<TargetName, kAttributeTargetCount> kTargets{{{"shape", AttributeTarget::shape},
                                                                  {"light", AttributeTarget::light},
                                                                  {"material", AttributeTarget::material},
                                                                  {"medium", AttributeTarget::medium},
                                                                  {"texture", AttributeTarget::texture}}};

}  // namespace

void DirectiveReader::note_world_content() {
  if (!in_world_) context_.warnings.add(place_, "there is no WorldBegin before the first shape, light or material");
}

void DirectiveReader::attribute() {
  const std::string name = quoted_argument("shape, light, material, medium or texture");
  const auto target = std::find_if(kTargets.begin(), kTargets.end(), [&](const TargetName& t) { return t.name == name; });
  if (target == kTargets.end()) place_.fail("Attribute takes shape, light, material, medium or texture, not \"" + name + "\"");
  const ParameterList added = plain_parameters();
  auto defaults = state_.defaults ? std::make_shared<AttributeDefaults>(*state_.defaults) : std::make_shared<AttributeDefaults>();
  auto& slot = (*defaults)[static_cast<std::size_t>(target->target)];
  // The latest come first, because lookups take the first that fits.
  auto merged = std::make_shared<std::vector<Parameter>>(added.own());
  if (slot != nullptr) {
    for (const Parameter& old : *slot) {
      const bool replaced = std::any_of(added.own().begin(), added.own().end(), [&](const Parameter& p) { return p.name == old.name; });
      if (!replaced) merged->push_back(old);
    }
  }
  slot = std::move(merged);
  state_.defaults = std::move(defaults);
}

void DirectiveReader::colour_space() {
  const std::string name = quoted_argument("the name of a colour space");
  if (name == "srgb") {
    state_.colour_space = ColourSpace::srgb;
  } else if (name == "dci-p3") {
    state_.colour_space = ColourSpace::dci_p3;
  } else if (name == "rec2020") {
    state_.colour_space = ColourSpace::rec2020;
  } else if (name == "aces2065-1") {
    state_.colour_space = ColourSpace::aces2065_1;
  } else {
    place_.fail("unknown colour space \"" + name + "\"; known are srgb dci-p3 rec2020 aces2065-1");
  }
}

// How pbrt itself would sample, integrate and filter: for Grove the command line says that.
void DirectiveReader::ignored_setting() {
  quoted_argument("a name");
  plain_parameters();
}

void DirectiveReader::option() {
  plain_parameters();
}

void DirectiveReader::film() {
  quoted_argument("the kind of film");
  description_.film = plain_parameters();
}

void DirectiveReader::camera() {
  CameraDirective camera;
  camera.type = quoted_argument("the kind of camera");
  camera.parameters = plain_parameters();
  camera.world_to_camera = state_.transform;
  if (is_usable(state_.transform)) coordinate_systems_["camera"] = affine_inverse(state_.transform);
  description_.camera = std::move(camera);
}

void DirectiveReader::material() {
  MaterialDirective material;
  material.type = quoted_argument("the kind of material");
  material.parameters = parameters(AttributeTarget::material);
  state_.material = static_cast<std::uint32_t>(description_.materials.size());
  description_.materials.push_back(std::move(material));
}

void DirectiveReader::make_named_material() {
  const std::string name = quoted_argument("the name of the material");
  MaterialDirective material;
  material.name = name;
  material.parameters = parameters(AttributeTarget::material);
  if (material.parameters.find("type", ParameterType::string) == nullptr)
    place_.fail("MakeNamedMaterial \"" + name + "\" has no \"string type\"");
  material.type = material.parameters.text("type", "");
  const auto id = static_cast<std::uint32_t>(description_.materials.size());
  if (!description_.named_materials.insert_or_assign(name, id).second)
    context_.warnings.add(place_, "the material \"" + name + "\" is defined twice; shapes from here on take the second");
  description_.materials.push_back(std::move(material));
}

void DirectiveReader::named_material() {
  const std::string name = quoted_argument("the name of a material");
  const auto found = description_.named_materials.find(name);
  if (found != description_.named_materials.end()) {
    state_.material = found->second;
    return;
  }
  state_.material = static_cast<std::uint32_t>(description_.materials.size());
  description_.materials.push_back({.name = {}, .type = {}, .parameters = ParameterList(place_), .later_name = name});
}

void DirectiveReader::make_named_medium() {
  quoted_argument("the name of the medium");
  parameters(AttributeTarget::medium);
  context_.warnings.add(place_, "participating media are left out");
}

void DirectiveReader::medium_interface() {
  quoted_argument("the name of a medium");
  if (tokens_->peek().kind == TokenKind::quoted) tokens_->next();
  context_.warnings.add(place_, "participating media are left out");
}

void DirectiveReader::texture() {
  TextureDirective texture;
  texture.name = quoted_argument("the name of the texture");
  const std::string values = quoted_argument("float or spectrum");
  if (values != "float" && values != "spectrum" && values != "color")
    place_.fail("a texture is of float or spectrum, not \"" + values + "\"");
  texture.is_spectrum = values != "float";
  texture.type = quoted_argument("the kind of texture");
  texture.parameters = parameters(AttributeTarget::texture);
  description_.textures.push_back(std::move(texture));
}

void DirectiveReader::light_source() {
  note_world_content();
  LightDirective light;
  light.type = quoted_argument("the kind of light");
  light.parameters = parameters(AttributeTarget::light);
  light.to_world = state_.transform;
  description_.lights.push_back(std::move(light));
}

void DirectiveReader::area_light_source() {
  AreaLightDirective light;
  light.type = quoted_argument("the kind of light");
  light.parameters = parameters(AttributeTarget::light);
  if (in_object_) {
    context_.warnings.add(place_, "area lights inside an object definition are left out, as in pbrt");
    return;
  }
  state_.area_light = static_cast<std::uint32_t>(description_.area_lights.size());
  description_.area_lights.push_back(std::move(light));
}

void DirectiveReader::shape() {
  note_world_content();
  ShapeDirective shape;
  shape.type = quoted_argument("the kind of shape");
  shape.parameters = parameters(AttributeTarget::shape);
  shape.to_world = state_.transform;
  shape.reverse_orientation = state_.reverse_orientation;
  shape.material = state_.material;
  shape.area_light = in_object_ ? kNone : state_.area_light;
  (in_object_ ? description_.objects.back().shapes : description_.shapes).push_back(std::move(shape));
}

}  // namespace grove::pbrt
