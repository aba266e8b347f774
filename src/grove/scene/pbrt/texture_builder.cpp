#include "grove/scene/pbrt/texture_builder.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "grove/base/parallel.h"
#include "grove/scene/pbrt/image_encoding.h"
#include "grove/scene/read_image.h"

namespace grove::pbrt {
namespace {

constexpr float kMiddle = 0.5F;

Texture constant_texture(const Vec4& value) {
  Texture texture;
  texture.kind = TextureKind::constant;
  texture.value[0] = value;
  return texture;
}

}  // namespace

TextureBuilder::TextureBuilder(const Description& description, Scene& scene, Context& context)
    : description_(description), scene_(scene), context_(context) {
  const std::vector<bool> used = used_textures();
  read_images(used);
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i]) continue;
    const TextureDirective& directive = description_.textures[i];
    Texture texture = make(directive);
    texture.name = directive.name;
    for (const Parameter& p : directive.parameters.own()) {
      if (!p.used) context_.warnings.add(p.place, "the texture \"" + directive.type + "\" has no parameter \"" + p.name + "\"");
    }
    limit_cost(texture, directive.parameters.place());
    auto& names = directive.is_spectrum ? colours_ : numbers_;
    names[directive.name] = static_cast<std::uint32_t>(scene_.textures.size());
    scene_.textures.push_back(std::move(texture));
  }
}

void TextureBuilder::read_images(const std::vector<bool>& used) {
  for (std::size_t i = 0; i < used.size(); ++i) {
    const TextureDirective& directive = description_.textures[i];
    if (used[i] && directive.type == "imagemap") images_[directive.parameters.text("filename", "")];
  }
  std::vector<std::pair<const std::string, LoadedImage>*> entries;
  for (auto& entry : images_) entries.push_back(&entry);
  parallel_for(entries.size(), 1, [&](std::size_t i) {
    try {
      entries[i]->second.image = std::make_shared<Image>(read_image(resolve_file(context_.directory, entries[i]->first)));
    } catch (const InputError& error) {
      entries[i]->second.problem = error.what();
    }
  });
}

TextureBuilder::LoadedImage& TextureBuilder::load(const std::string& file) {
  const auto [entry, is_new] = images_.try_emplace(file);
  LoadedImage& loaded = entry->second;
  if (!is_new) return loaded;
  try {
    loaded.image = std::make_shared<Image>(read_image(resolve_file(context_.directory, file)));
  } catch (const InputError& error) {
    loaded.problem = error.what();
  }
  return loaded;
}

std::uint32_t TextureBuilder::add_image(LoadedImage& loaded) {
  if (loaded.id == kNone) {
    loaded.id = static_cast<std::uint32_t>(scene_.images.size());
    scene_.images.push_back(loaded.image);
  }
  return loaded.id;
}

std::shared_ptr<const Image> TextureBuilder::image(const std::string& file) {
  const LoadedImage& loaded = load(file);
  if (loaded.image == nullptr) throw InputError(loaded.problem);
  return loaded.image;
}

std::uint32_t TextureBuilder::image_texture(const std::string& file, bool srgb, const Place& place) {
  LoadedImage& loaded = load(file);
  if (loaded.image == nullptr) {
    context_.warnings.add(place, loaded.problem + "; the image is left out");
    return kNoTexture;
  }
  Texture texture;
  texture.name = file;
  texture.kind = TextureKind::image;
  texture.image = add_image(loaded);
  texture.srgb = srgb && !loaded.image->is_float();
  texture.uv_transform = Mat3(Vec3(1.0F, 0.0F, 0.0F), Vec3(0.0F, -1.0F, 0.0F), Vec3(0.0F, 1.0F, 1.0F));
  scene_.textures.push_back(std::move(texture));
  return static_cast<std::uint32_t>(scene_.textures.size() - 1);
}

std::uint32_t TextureBuilder::find(const std::string& name, bool is_spectrum, const Place& place) {
  const auto& first = is_spectrum ? colours_ : numbers_;
  const auto& second = is_spectrum ? numbers_ : colours_;
  if (const auto found = first.find(name); found != first.end()) return found->second;
  if (const auto found = second.find(name); found != second.end()) return found->second;
  context_.warnings.add(place, "no Texture before this line is called \"" + name + "\"");
  return kNoTexture;
}

ColourParameter TextureBuilder::colour_parameter(const ParameterList& parameters, std::string_view name, const Vec3& otherwise,
                                                 SpectrumUse use) {
  if (const auto texture = parameters.texture(name)) {
    const std::uint32_t id = find(*texture, true, parameters.find(name, ParameterType::texture)->place);
    return {.value = id == kNoTexture ? otherwise : Vec3(1.0F), .texture = id};
  }
  return {.value = colour(parameters, name, use, context_).value_or(otherwise), .texture = kNoTexture};
}

ScalarParameter TextureBuilder::scalar_parameter(const ParameterList& parameters, std::string_view name, float otherwise) {
  if (const auto texture = parameters.texture(name)) {
    const std::uint32_t id = find(*texture, false, parameters.find(name, ParameterType::texture)->place);
    return {.value = id == kNoTexture ? otherwise : 1.0F, .texture = id};
  }
  return {.value = parameters.number(name, otherwise), .texture = kNoTexture};
}

Texture TextureBuilder::make(const TextureDirective& directive) {
  const bool spectrum = directive.is_spectrum;
  if (directive.type == "imagemap") return make_image(directive);
  Texture texture;
  if (directive.type == "constant") {
    set_operand(texture, 0, directive, "value", 1.0F, spectrum);
  } else if (directive.type == "scale") {
    texture.kind = TextureKind::scale;
    // Version 3 called the two tex1 and tex2.
    const bool v3 = directive.parameters.find("tex1") != nullptr || directive.parameters.find("tex2") != nullptr;
    set_operand(texture, 0, directive, v3 ? "tex1" : "tex", 1.0F, spectrum);
    set_operand(texture, 1, directive, v3 ? "tex2" : "scale", 1.0F, v3 && spectrum);
  } else if (directive.type == "mix") {
    texture.kind = TextureKind::mix;
    set_operand(texture, 0, directive, "tex1", 0.0F, spectrum);
    set_operand(texture, 1, directive, "tex2", 1.0F, spectrum);
    set_amount(texture, directive, "amount");
  } else if (directive.type == "checkerboard" && directive.parameters.integer("dimension", 2) == 2) {
    texture.kind = TextureKind::checkerboard;
    set_operand(texture, 0, directive, "tex1", 1.0F, spectrum);
    set_operand(texture, 1, directive, "tex2", 0.0F, spectrum);
    set_mapping(texture, directive, false);
  } else {
    return make_stand_in(directive);
  }
  return texture;
}

// Textures of textures are evaluated like a tree: a chain in which each names the one before twice would take for ever.
void TextureBuilder::limit_cost(Texture& texture, const Place& place) {
  constexpr std::uint32_t kMaxCost = 1024;
  costs_.resize(scene_.textures.size(), 1);
  std::uint32_t cost = 1;
  for (const std::uint32_t operand : {texture.operand[0], texture.operand[1], texture.amount_texture}) {
    if (operand != kNoTexture) cost += costs_[operand];
  }
  if (cost > kMaxCost) {
    context_.warnings.add(place, "a texture made of more than 1024 others is left out; grey stands in for it");
    texture = constant_texture(Vec4(Vec3(kMiddle), 1.0F));
    cost = 1;
  }
  costs_.push_back(cost);
}

// Kinds that we do not have: the middle of what they show.
Texture TextureBuilder::make_stand_in(const TextureDirective& directive) {
  context_.warnings.add(directive.parameters.place(),
                        "the texture kind \"" + directive.type + "\" is not supported; an even value in its middle stands in for it");
  for (const Parameter& parameter : directive.parameters.own()) directive.parameters.ignore(parameter.name);
  Vec3 sum(0.0F);
  float count = 0.0F;
  for (const char* name : {"tex1", "tex2", "inside", "outside", "v00", "v01", "v10", "v11"}) {
    const Parameter* p = directive.parameters.find(name);
    if (p == nullptr || p->type == ParameterType::texture) continue;
    if (const auto value = colour(directive.parameters, name, SpectrumUse::unbounded, context_)) {
      sum += *value;
      count += 1.0F;
    }
  }
  return constant_texture(Vec4(count > 0.0F ? sum / count : Vec3(kMiddle), 1.0F));
}

void TextureBuilder::set_operand(Texture& texture, int i, const TextureDirective& directive, std::string_view name, float otherwise,
                                 bool is_spectrum) {
  const ColourParameter operand = [&]() -> ColourParameter {
    if (const auto other = directive.parameters.texture(name))
      return {.value = Vec3(kMiddle), .texture = find(*other, is_spectrum, directive.parameters.place())};
    return colour_parameter(directive.parameters, name, Vec3(otherwise), SpectrumUse::unbounded);
  }();
  texture.value[i] = Vec4(operand.value, 1.0F);
  texture.operand[i] = operand.texture;
  // A constant is its own value: one that is a texture becomes that texture times 1.
  if (texture.kind == TextureKind::constant && operand.texture != kNoTexture) {
    texture.kind = TextureKind::scale;
    texture.value[1] = Vec4(1.0F);
  }
}

void TextureBuilder::set_amount(Texture& texture, const TextureDirective& directive, std::string_view name) {
  const ScalarParameter amount = scalar_parameter(directive.parameters, name, 0.5F);
  texture.amount = amount.value;
  texture.amount_texture = amount.texture;
}

// pbrt's v points up; our images have v = 0 in their top row.
void TextureBuilder::set_mapping(Texture& texture, const TextureDirective& directive, bool v_down) {
  const ParameterList& p = directive.parameters;
  const std::string mapping = p.text("mapping", "uv");
  if (mapping != "uv") {
    context_.warnings.add(p.place(), "texture mapping \"" + mapping + "\" is not supported; (u, v) of the surface is used");
    for (const char* name : {"v1", "v2"}) p.ignore(name);
  }
  const Vec2 scale(p.number("uscale", 1.0F), p.number("vscale", 1.0F));
  const Vec2 delta(p.number("udelta", 0.0F), p.number("vdelta", 0.0F));
  const float sign = v_down ? -1.0F : 1.0F;
  texture.uv_transform =
      Mat3(Vec3(scale.x, 0.0F, 0.0F), Vec3(0.0F, sign * scale.y, 0.0F), Vec3(delta.x, v_down ? 1.0F - delta.y : delta.y, 1.0F));
}

Texture TextureBuilder::make_image(const TextureDirective& directive) {
  const ParameterList& p = directive.parameters;
  const std::string file = p.text("filename", "");
  for (const char* name : {"maxanisotropy", "trilinear"}) p.ignore(name);
  Texture texture;
  texture.kind = TextureKind::image;
  texture.value[0] = Vec4(Vec3(p.number("scale", 1.0F)), 1.0F);
  texture.invert = p.flag("invert", false);
  if (texture.invert && texture.value[0].x != 1.0F) {
    context_.warnings.add(p.place(), "\"scale\" of a texture with \"invert\" is left out");
    texture.value[0] = Vec4(1.0F);
  }
  texture.filter = p.text("filter", "bilinear") == "point" ? TextureFilter::nearest : TextureFilter::linear;
  set_mapping(texture, directive, true);
  const std::string wrap = p.text("wrap", "repeat");
  texture.wrap_u = wrap == "clamp" ? TextureWrap::clamp : wrap == "black" ? TextureWrap::black : TextureWrap::repeat;
  texture.wrap_v = texture.wrap_u;
  if (wrap != "repeat" && wrap != "clamp" && wrap != "black")
    context_.warnings.add(p.place(), "texture wrap \"" + wrap + "\" is not known; it repeats");

  const std::string encoding_name = p.text("encoding", "sRGB");
  const std::optional<ImageEncoding> encoding = parse_image_encoding(encoding_name);
  if (!encoding) p.place().fail("unknown encoding \"" + encoding_name + "\"; known are sRGB, linear and \"gamma 2.2\"");
  LoadedImage& loaded = load(file);
  if (loaded.image == nullptr) {
    context_.warnings.add(p.place(), loaded.problem + "; grey stands in for the image");
    return constant_texture(Vec4(Vec3(kMiddle), 1.0F));
  }
  texture.srgb = encoding->srgb && !loaded.image->is_float();
  if (encoding->gamma != 1.0F && !loaded.image->is_float()) {
    texture.image = static_cast<std::uint32_t>(scene_.images.size());
    scene_.images.push_back(std::make_shared<Image>(decode_gamma(*loaded.image, encoding->gamma)));
  } else {
    texture.image = add_image(loaded);
  }
  return texture;
}

std::uint32_t TextureBuilder::raised_image(const Texture& texture, float exponent) {
  const Image& source = *scene_.images[texture.image];
  auto raised = std::make_shared<Image>(map_first_channel(source, texture.srgb, [&](float value) {
    // The factor on the image moves out of the power.
    return std::pow(std::max(0.0F, texture.invert ? 1.0F - value : value), exponent);
  }));
  scene_.images.push_back(std::move(raised));
  return static_cast<std::uint32_t>(scene_.images.size() - 1);
}

std::uint32_t TextureBuilder::raised_to_power(std::uint32_t id, float exponent) {
  if (id == kNoTexture) return kNoTexture;
  // Operands have lower numbers: going down finds what takes part, going up builds it.
  std::vector<bool> needed(id + 1, false);
  needed[id] = true;
  for (std::uint32_t i = id + 1; i-- > 0;) {
    if (!needed[i] || raised_.contains({i, exponent})) continue;
    for (const std::uint32_t operand : scene_.textures[i].operand) {
      if (operand != kNoTexture) needed[operand] = true;
    }
  }
  for (std::uint32_t i = 0; i <= id; ++i) {
    if (!needed[i] || raised_.contains({i, exponent})) continue;
    Texture texture = scene_.textures[i];
    if (texture.kind == TextureKind::image) {
      texture.image = raised_image(texture, exponent);
      texture.srgb = false;
      texture.invert = false;
    }
    for (int operand = 0; operand < 2; ++operand) {
      for (int channel = 0; channel < 3; ++channel) {
        texture.value[operand][channel] = std::pow(std::max(0.0F, texture.value[operand][channel]), exponent);
      }
      if (texture.operand[operand] != kNoTexture) texture.operand[operand] = raised_.at({texture.operand[operand], exponent});
    }
    raised_[{i, exponent}] = static_cast<std::uint32_t>(scene_.textures.size());
    scene_.textures.push_back(std::move(texture));
  }
  return raised_.at({id, exponent});
}

// Everything that a material or a shape names, and what those textures name in turn, which comes before them.
std::vector<bool> TextureBuilder::used_textures() const {
  std::set<std::string_view> wanted;
  const auto collect = [&wanted](const ParameterList& parameters) {
    for (const std::string_view name : parameters.texture_names()) wanted.insert(name);
  };
  for (const MaterialDirective& material : description_.materials) collect(material.parameters);
  for (const ShapeDirective& shape : description_.shapes) collect(shape.parameters);
  for (const ObjectDefinition& object : description_.objects) {
    for (const ShapeDirective& shape : object.shapes) collect(shape.parameters);
  }
  std::vector<bool> used(description_.textures.size(), false);
  for (std::size_t i = used.size(); i-- > 0;) {
    const TextureDirective& directive = description_.textures[i];
    if (!wanted.contains(directive.name)) continue;
    used[i] = true;
    collect(directive.parameters);
  }
  return used;
}

}  // namespace grove::pbrt
