#include "grove/scene/pbrt/light_builder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/mat3x3.hpp>

#include "grove/scene/pbrt/octahedral.h"

namespace grove::pbrt {
namespace {

constexpr float kDegree = kPi / 180.0F;

class LightBuilder {
 public:
  LightBuilder(TextureBuilder& textures, Scene& scene, Context& context) : textures_(textures), scene_(scene), context_(context) {}

  void build(const LightDirective& light) {
    const ParameterList& p = light.parameters;
    if (!is_usable(light.to_world)) {
      context_.warnings.add(p.place(), "a light under a transform that is singular, projective or not finite is left out");
      return;
    }
    if (light.type == "infinite" || light.type == "exinfinite") {
      build_infinite(light);
    } else if (light.type == "distant") {
      build_distant(light);
    } else if (light.type == "point" || light.type == "goniometric" || light.type == "projection") {
      build_point(light);
    } else if (light.type == "spot") {
      build_spot(light);
    } else {
      context_.warnings.add(p.place(), "the light \"" + light.type + "\" is not supported and left out");
      return;
    }
    for (const Parameter& parameter : p.own()) {
      if (!parameter.used)
        context_.warnings.add(parameter.place, "the light \"" + light.type + "\" has no parameter \"" + parameter.name + "\"");
    }
  }

 private:
  // `name` is L or I; version 3 wrote the factor as a colour.
  Vec3 strength(const ParameterList& p, const char* name) {
    const Vec3 value = colour(p, name, SpectrumUse::illuminant, context_).value_or(Vec3(1.0F));
    const Parameter* scale = p.find("scale");
    if (scale != nullptr && scale->type == ParameterType::rgb)
      return value * colour(p, "scale", SpectrumUse::illuminant, context_).value_or(Vec3(1.0F));
    return value * p.number("scale", 1.0F);
  }

  void add(PunctualLight light) {
    light.intensity = glm::max(light.intensity, Vec3(0.0F));
    if (light.intensity != Vec3(0.0F)) scene_.lights.push_back(std::move(light));
  }

  bool set_direction(PunctualLight& result, const LightDirective& light, const Vec3& from, const Vec3& to) {
    const Vec3 direction = transform_vector(light.to_world, to - from);
    const float length = glm::length(direction);
    if (!(length > 0.0F) || !std::isfinite(length)) {
      context_.warnings.add(light.parameters.place(), "a light without a direction (\"from\" is \"to\") is left out");
      return false;
    }
    result.direction = direction / length;
    return true;
  }

  void build_distant(const LightDirective& light) {
    const ParameterList& p = light.parameters;
    PunctualLight result;
    result.kind = PunctualLightKind::directional;
    result.intensity = strength(p, "L");
    if (const float illuminance = p.number("illuminance", -1.0F); illuminance > 0.0F) result.intensity *= illuminance;
    const Vec3 from = p.point("from", Vec3(0.0F)), to = p.point("to", Vec3(0.0F, 0.0F, 1.0F));
    if (set_direction(result, light, from, to)) add(std::move(result));
  }

  void build_point(const LightDirective& light) {
    const ParameterList& p = light.parameters;
    if (light.type != "point") {
      context_.warnings.add(p.place(), "the light \"" + light.type + "\" is shown as a point light, without its picture");
      for (const char* name : {"filename", "mapname", "fov"}) p.ignore(name);
    }
    PunctualLight result;
    result.position = transform_point(light.to_world, p.point("from", Vec3(0.0F)));
    result.intensity = strength(p, "I");
    if (const float power = p.number("power", -1.0F); power > 0.0F) result.intensity *= power / (4.0F * kPi);
    add(std::move(result));
  }

  void build_spot(const LightDirective& light) {
    const ParameterList& p = light.parameters;
    PunctualLight result;
    result.kind = PunctualLightKind::spot;
    const Vec3 from = p.point("from", Vec3(0.0F)), to = p.point("to", Vec3(0.0F, 0.0F, 1.0F));
    result.position = transform_point(light.to_world, from);
    result.intensity = strength(p, "I");
    const float cone = p.number("coneangle", 30.0F);
    const float delta = p.number(p.find("conedeltaangle") != nullptr ? "conedeltaangle" : "conedelta", 5.0F);
    if (!(cone > 0.0F && cone <= 90.0F))
      context_.warnings.add(p.place(), "\"coneangle\" of a spot light must be above 0 and at most 90 degrees; it is put there");
    result.outer_angle = std::clamp(cone, 0.1F, 90.0F) * kDegree;
    // The renderer divides by the width of the soft edge.
    result.inner_angle = std::clamp((cone - delta) * kDegree, 0.0F, 0.999F * result.outer_angle);
    if (const float power = p.number("power", -1.0F); power > 0.0F) {
      // Light inside the cone, and on average half of it over the soft edge.
      const float inner = std::cos(result.inner_angle), outer = std::cos(result.outer_angle);
      result.intensity *= power / (2.0F * kPi * ((1.0F - inner) + 0.5F * (inner - outer)));
    }
    if (set_direction(result, light, from, to)) add(std::move(result));
  }

  void build_infinite(const LightDirective& light) {
    const ParameterList& p = light.parameters;
    if (p.find("portal") != nullptr) context_.warnings.add(p.place(), "\"portal\" is left out: the light comes from all around");
    for (const char* name : {"samples", "nsamples"}) p.ignore(name);
    const std::string file = p.text(p.find("filename") != nullptr ? "filename" : "mapname", "");
    const Vec3 radiance = strength(p, "L");
    const float illuminance = p.number("illuminance", -1.0F);
    Environment environment;
    environment.radiance = radiance;
    if (!file.empty()) {
      set_image(environment, light, file, illuminance);
    } else if (illuminance > 0.0F) {
      environment.radiance *= illuminance / kPi;
    }
    add_environment(environment, p.place());
  }

  void set_image(Environment& environment, const LightDirective& light, const std::string& file, float illuminance) {
    const Place& place = light.parameters.place();
    std::shared_ptr<const Image> source = textures_.image(file);
    const bool square = source->width == source->height;
    if (!square && source->width != 2 * source->height)
      place.fail("the environment \"" + file + "\" is " + std::to_string(source->width) + " x " + std::to_string(source->height) +
                 "; it must be square (equal-area octahedral) or twice as wide as high");
    if (!square)
      context_.warnings.add(place, "an environment that is twice as wide as high is read as latitude and longitude, z up, as in pbrt-v3");
    if (!square) {
      source = std::make_shared<Image>(equirectangular_to_octahedral(*source));
    } else if (!source->is_float()) {
      source = std::make_shared<Image>(to_linear_floats(*source));
    }
    environment.image = static_cast<std::uint32_t>(scene_.images.size());
    scene_.images.push_back(source);
    environment.mapping = EnvironmentMapping::octahedral;
    environment.world_to_environment = Mat3(glm::inverse(glm::dmat3(light.to_world)));
    // A uniform scale in the transform means nothing for directions.
    const float size = std::cbrt(std::abs(glm::determinant(environment.world_to_environment)));
    if (size > 0.0F && std::isfinite(size)) environment.world_to_environment /= size;
    if (illuminance > 0.0F) {
      const float measured = upper_illuminance(*source);
      if (measured > 0.0F) environment.radiance *= illuminance / measured;
    }
  }

  // A Scene has one environment: constant ones add up, of images the first stays.
  void add_environment(Environment added, const Place& place) {
    Environment& current = scene_.environment;
    constexpr std::uint32_t kNoImage = 0xffffffffU;
    if (!added.is_on()) return;
    if (!current.is_on()) {
      current = added;
    } else if (current.image == kNoImage && added.image == kNoImage) {
      current.radiance += added.radiance;
    } else {
      context_.warnings.add(place, "of several infinite lights with images only the one with the first image is kept");
      if (current.image == kNoImage) current = added;
    }
  }

  TextureBuilder& textures_;
  Scene& scene_;
  Context& context_;
};

}  // namespace

void build_lights(const Description& description, TextureBuilder& textures, Scene& scene, Context& context) {
  LightBuilder builder(textures, scene, context);
  for (const LightDirective& light : description.lights) builder.build(light);
}

}  // namespace grove::pbrt
