#include "grove/scene/pbrt/material_builder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include "grove/scene/pbrt/named_spectra.h"

namespace grove::pbrt {
namespace {

// A renderer may look at both sides of every mix.
constexpr std::uint32_t kMaxMixDepth = 8;

// pbrt's albedo where a file gives none.
constexpr Vec3 kGrey{0.5F};

bool has_texture(const Material& m) {
  for (const std::uint32_t texture : {m.base_colour.texture, m.transmission_colour.texture, m.emission.texture, m.roughness.texture,
                                      m.coat_roughness.texture, m.bump.texture, m.alpha.texture, m.mix_amount.texture, m.normal_texture}) {
    if (texture != kNoTexture) return true;
  }
  return false;
}

[[noreturn]] void fail_mix(const ParameterList& p) {
  p.place().fail("mixes of mixes are nested more than " + std::to_string(kMaxMixDepth) + " deep, or in a circle");
}

}  // namespace

std::uint32_t MaterialBuilder::named(const std::string& name, const Place& place) {
  const auto found = description_.named_materials.find(name);
  if (found != description_.named_materials.end()) return found->second;
  context_.warnings.add(place, "no MakeNamedMaterial is called \"" + name + "\"; grey stands in for it");
  return 0;
}

std::uint32_t MaterialBuilder::build(std::uint32_t id) {
  const MaterialDirective& directive = description_.materials[id];
  if (built_[id] != kNone) return built_[id];
  if (!directive.later_name.empty()) return built_[id] = build(named(directive.later_name, directive.parameters.place()));
  Material material = make(directive);
  add_relief(material, directive.parameters);
  material.name = directive.name;
  for (const Parameter& p : directive.parameters.own()) {
    if (!p.used) context_.warnings.add(p.place, "the material \"" + directive.type + "\" has no parameter \"" + p.name + "\"");
  }
  return built_[id] = add(std::move(material));
}

// Version 3's names lead to the nearest of version 4.
Material MaterialBuilder::make(const MaterialDirective& directive) {
  const std::string& type = directive.type;
  const ParameterList& p = directive.parameters;
  for (const char* name : {"type", "remaproughness"}) p.ignore(name);
  Material m;
  if (type == "diffuse" || type == "matte") {
    make_diffuse(m, p);
  } else if (type == "coateddiffuse" || type == "plastic" || type == "substrate") {
    make_coated_diffuse(m, p);
  } else if (type == "conductor" || type == "metal") {
    m.kind = MaterialKind::conductor;
    make_conductor(m, p, "");
    m.roughness = roughness(p, "", 0.0F);
  } else if (type == "coatedconductor") {
    make_coated_conductor(m, p);
  } else if (type == "mirror") {
    m.kind = MaterialKind::conductor;
    m.base_colour = textures_.colour_parameter(p, "Kr", Vec3(0.9F), SpectrumUse::albedo);
    m.roughness.value = 0.0F;
  } else if (type == "dielectric" || type == "glass" || type == "thindielectric") {
    m.kind = type == "thindielectric" ? MaterialKind::thin_dielectric : MaterialKind::dielectric;
    make_dielectric(m, p);
  } else if (type == "diffusetransmission") {
    make_diffuse_transmission(m, p);
  } else if (type == "interface" || type == "none" || type.empty()) {
    m.kind = MaterialKind::interface;
  } else if (type == "mix") {
    make_mix(m, p);
  } else if (type == "hair") {
    make_hair(m, p);
  } else {
    make_stand_in(m, directive);
  }
  return m;
}

void MaterialBuilder::make_diffuse(Material& m, const ParameterList& p) {
  m.kind = MaterialKind::diffuse;
  p.ignore("sigma");
  m.base_colour = textures_.colour_parameter(p, p.find("Kd") != nullptr ? "Kd" : "reflectance", kGrey, SpectrumUse::albedo);
}

void MaterialBuilder::make_coated_diffuse(Material& m, const ParameterList& p) {
  make_diffuse(m, p);
  m.kind = MaterialKind::coated_diffuse;
  m.roughness = roughness(p, "", 0.0F);
  m.ior = spectral_number(p, "eta", context_).value_or(1.5F);
  p.ignore("Ks");
  ignore_layer(p);
}

// The medium inside the coat, and how pbrt walks through it.
void MaterialBuilder::ignore_layer(const ParameterList& p) {
  for (const char* name : {"thickness", "interface.thickness", "g", "maxdepth", "nsamples"}) p.ignore(name);
  if (const auto albedo = colour(p, "albedo", SpectrumUse::albedo, context_); albedo && *albedo != Vec3(0.0F))
    context_.warnings.add(p.place(), "the scattering medium inside a coat (\"albedo\") is left out");
}

void MaterialBuilder::make_conductor(Material& m, const ParameterList& p, const std::string& prefix) {
  if (p.find("reflectance") != nullptr) {
    m.base_colour = textures_.colour_parameter(p, "reflectance", kGrey, SpectrumUse::albedo);
    return;
  }
  const std::string eta = prefix + "eta", k = prefix + "k";
  if (p.texture(eta) || p.texture(k))
    context_.warnings.add(p.place(), "textures for \"eta\" and \"k\" are not supported; copper stands in");
  m.has_complex_ior = true;
  m.ior_colour = colour(p, eta, SpectrumUse::unbounded, context_).value_or(*named_spectrum("metal-Cu-eta"));
  m.absorption = colour(p, k, SpectrumUse::unbounded, context_).value_or(*named_spectrum("metal-Cu-k"));
}

void MaterialBuilder::make_coated_conductor(Material& m, const ParameterList& p) {
  m.kind = MaterialKind::coated_conductor;
  make_conductor(m, p, "conductor.");
  m.roughness = roughness(p, "conductor.", 0.0F);
  m.coat_roughness = roughness(p, "interface.", 0.0F);
  m.ior = spectral_number(p, "interface.eta", context_).value_or(1.5F);
  ignore_layer(p);
}

void MaterialBuilder::make_dielectric(Material& m, const ParameterList& p) {
  m.roughness = m.kind == MaterialKind::dielectric ? roughness(p, "", 0.0F) : ScalarParameter{.value = 0.0F};
  const auto eta = spectral_number(p, "eta", context_);
  m.ior = eta ? *eta : p.number("index", 1.5F);
  // Version 3's colours of reflection and transmission are white as a rule.
  for (const char* name : {"Kr", "Kt"}) p.ignore(name);
}

void MaterialBuilder::make_diffuse_transmission(Material& m, const ParameterList& p) {
  m.kind = MaterialKind::diffuse_transmission;
  const float scale = p.number("scale", 1.0F);
  m.base_colour = textures_.colour_parameter(p, "reflectance", Vec3(0.25F), SpectrumUse::albedo);
  m.transmission_colour = textures_.colour_parameter(p, "transmittance", Vec3(0.25F), SpectrumUse::albedo);
  m.base_colour.value *= scale;
  m.transmission_colour.value *= scale;
}

void MaterialBuilder::make_mix(Material& m, const ParameterList& p) {
  m.kind = MaterialKind::mix;
  const Parameter* names = p.find("materials", ParameterType::string);
  if (names == nullptr || names->strings.size() != 2) p.place().fail("a mix takes \"string materials\" with two names");
  if (depth_ >= kMaxMixDepth) fail_mix(p);
  ++depth_;
  for (std::size_t i = 0; i < 2; ++i) {
    m.mix_material[i] = build(named(names->strings[i], p.place()));
    if (heights_[m.mix_material[i]] >= kMaxMixDepth) fail_mix(p);
  }
  --depth_;
  m.mix_amount = textures_.scalar_parameter(p, "amount", 0.5F);
}

// The reflectance that a lock of hair has as a whole, by the fit of Chiang, Bitterli, Tappan, Burley 2016, "A Practical and Controllable
// Hair and Fur Model for Production Path Tracing", equation 9: sqrt(sigma_a) = -ln(C) / f(beta_n). A glossy coat stands for its highlight.
void MaterialBuilder::make_hair(Material& m, const ParameterList& p) {
  context_.warnings.add(p.place(), "hair is shown as a coated diffuse surface of its colour");
  m.kind = MaterialKind::coated_diffuse;
  m.ior = p.number("eta", 1.55F);
  const float beta_m = p.number("beta_m", 0.3F);
  const float beta_n = p.number("beta_n", 0.3F);
  p.ignore("alpha");
  m.roughness.value = std::sqrt(std::max(0.0F, beta_m));
  if (p.find("reflectance") != nullptr || p.find("color") != nullptr) {
    m.base_colour = textures_.colour_parameter(p, p.find("reflectance") != nullptr ? "reflectance" : "color", kGrey, SpectrumUse::albedo);
    return;
  }
  // Absorption by concentration of the two melanins, and without any the value that pbrt assumes.
  constexpr Vec3 kEumelanin{0.419F, 0.697F, 1.37F};
  constexpr Vec3 kPheomelanin{0.187F, 0.4F, 1.05F};
  const bool has_melanin = p.find("eumelanin") != nullptr || p.find("pheomelanin") != nullptr;
  Vec3 sigma = has_melanin ? p.number("eumelanin", 0.0F) * kEumelanin + p.number("pheomelanin", 0.0F) * kPheomelanin : 1.3F * kEumelanin;
  if (const auto given = colour(p, "sigma_a", SpectrumUse::unbounded, context_)) sigma = *given;
  const float b = beta_n;
  const float f = 5.969F - 0.215F * b + 2.532F * b * b - 10.73F * b * b * b + 5.574F * b * b * b * b + 0.245F * b * b * b * b * b;
  m.base_colour.value = glm::clamp(glm::exp(-f * glm::sqrt(glm::max(sigma, Vec3(0.0F)))), Vec3(0.0F), Vec3(1.0F));
}

// Materials that we do not have: the nearest that keeps their colour.
void MaterialBuilder::make_stand_in(Material& m, const MaterialDirective& directive) {
  const ParameterList& p = directive.parameters;
  context_.warnings.add(p.place(), "the material \"" + directive.type + "\" is not supported; a coated diffuse surface stands in for it");
  m.kind = MaterialKind::coated_diffuse;
  m.roughness = roughness(p, "", directive.type == "measured" ? 0.25F : 0.0F);
  const auto eta = p.find("eta") != nullptr ? spectral_number(p, "eta", context_) : std::nullopt;
  m.ior = eta.value_or(1.33F);
  for (const char* name : {"reflectance", "Kd", "color"}) {
    if (p.find(name) == nullptr) continue;
    m.base_colour = textures_.colour_parameter(p, name, kGrey, SpectrumUse::albedo);
    break;
  }
  if (m.base_colour.texture == kNoTexture && m.base_colour.value == Vec3(1.0F)) m.base_colour.value = kGrey;
  for (const Parameter& parameter : p.own()) p.ignore(parameter.name);
}

// pbrt's alpha is sqrt(roughness) when remapped, else the roughness itself; ours is the square of our roughness.
ScalarParameter MaterialBuilder::roughness(const ParameterList& p, const std::string& prefix, float otherwise) {
  const float exponent = p.flag("remaproughness", true) ? 0.25F : 0.5F;
  const ScalarParameter even = textures_.scalar_parameter(p, prefix + "roughness", otherwise);
  const ScalarParameter u =
      p.find(prefix + "uroughness") != nullptr ? textures_.scalar_parameter(p, prefix + "uroughness", otherwise) : even;
  const ScalarParameter v =
      p.find(prefix + "vroughness") != nullptr ? textures_.scalar_parameter(p, prefix + "vroughness", otherwise) : even;
  if (u.texture == kNoTexture && v.texture == kNoTexture) {
    return {.value = std::pow(std::max(0.0F, 0.5F * (u.value + v.value)), exponent)};
  }
  const ScalarParameter& textured = u.texture != kNoTexture ? u : v;
  return {.value = 1.0F, .texture = textures_.raised_to_power(textured.texture, exponent)};
}

void MaterialBuilder::add_relief(Material& m, const ParameterList& p) {
  const std::string normal_map = p.text("normalmap", "");
  if (!normal_map.empty()) m.normal_texture = textures_.image_texture(normal_map, false, p.place());
  const char* name = p.find("displacement") != nullptr ? "displacement" : "bumpmap";
  if (p.texture(name)) m.bump = textures_.scalar_parameter(p, name, 0.0F);
  p.ignore("displacement");
}

std::uint32_t MaterialBuilder::material_of(const ShapeDirective& shape) {
  const std::uint32_t base = build(shape.material);
  const std::string alpha_texture = shape.parameters.texture("alpha").value_or("");
  const float alpha = shape.parameters.number("alpha", 1.0F);
  if (shape.area_light == kNone && alpha_texture.empty() && alpha >= 1.0F) return base;
  const auto [entry, is_new] = variants_.try_emplace({base, shape.area_light, alpha_texture, alpha}, kNone);
  if (!is_new) return entry->second;
  Material material = scene_.materials[base];
  if (shape.area_light != kNone) add_emission(material, description_.area_lights[shape.area_light]);
  add_alpha(material, shape);
  return entry->second = add(std::move(material));
}

void MaterialBuilder::add_emission(Material& m, const AreaLightDirective& light) {
  const ParameterList& p = light.parameters;
  if (light.type != "diffuse" && light.type != "area") {
    context_.warnings.add(p.place(), "the area light \"" + light.type + "\" is not supported; known is diffuse");
    return;
  }
  m.emission.value = colour(p, "L", SpectrumUse::illuminant, context_).value_or(Vec3(1.0F)) * p.number("scale", 1.0F);
  m.two_sided_emission = p.flag("twosided", false);
  if (p.find("power") != nullptr) context_.warnings.add(p.place(), "\"power\" of an area light is left out; its L and scale hold");
  const std::string file = p.text("filename", "");
  if (!file.empty()) m.emission.texture = textures_.image_texture(file, true, p.place());
  for (const char* name : {"nsamples", "samples"}) p.ignore(name);
  for (const Parameter& parameter : p.own()) {
    if (!parameter.used) context_.warnings.add(parameter.place, "an area light has no parameter \"" + parameter.name + "\"");
  }
}

void MaterialBuilder::add_alpha(Material& m, const ShapeDirective& shape) {
  const ScalarParameter alpha = textures_.scalar_parameter(shape.parameters, "alpha", 1.0F);
  if (alpha.texture == kNoTexture && alpha.value >= 1.0F) return;
  m.alpha_mode = AlphaMode::blend;
  m.alpha = alpha;
}

std::uint32_t MaterialBuilder::add(Material m) {
  const bool is_mix = m.kind == MaterialKind::mix;
  heights_.push_back(is_mix ? 1 + std::max(heights_[m.mix_material[0]], heights_[m.mix_material[1]]) : 0);
  textured_.push_back(has_texture(m) || (is_mix && (textured_[m.mix_material[0]] || textured_[m.mix_material[1]])));
  scene_.materials.push_back(std::move(m));
  return static_cast<std::uint32_t>(scene_.materials.size() - 1);
}

}  // namespace grove::pbrt
