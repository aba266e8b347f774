#include "grove/scene/pbrt/camera_builder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/mat3x3.hpp>

namespace grove::pbrt {
namespace {

constexpr std::int32_t kMaxResolution = 65536;

std::uint32_t resolution(const ParameterList& film, std::string_view name, std::int32_t otherwise) {
  const std::int32_t value = film.integer(name, otherwise);
  if (value < 1 || value > kMaxResolution)
    film.find(name)->place.fail("\"" + std::string(name) + "\" must be between 1 and " + std::to_string(kMaxResolution));
  return static_cast<std::uint32_t>(value);
}

void build_film(const ParameterList& film, Scene& scene, Context& context) {
  scene.film.width = resolution(film, "xresolution", 1280);
  scene.film.height = resolution(film, "yresolution", 720);
  for (const char* name : {"iso", "exposuretime", "whitebalance", "sensor", "maxcomponentvalue"}) {
    if (film.find(name) != nullptr)
      context.warnings.add(film.place(), "the film's \"" + std::string(name) + "\" is left out; the picture is linear, at exposure 1");
  }
  for (const char* name : {"cropwindow", "pixelbounds"}) {
    if (film.find(name) != nullptr) context.warnings.add(film.place(), "the film's \"" + std::string(name) + "\" is left out");
  }
}

// pbrt's camera looks along +z with +x right and +y up; ours along -z. A scale in the transform moves into the lengths of the lens, so that
// the camera's matrix measures in world units.
void build_perspective(const CameraDirective& directive, Scene& scene, Context& context) {
  const ParameterList& p = directive.parameters;
  if (!is_usable(directive.world_to_camera)) {
    context.warnings.add(p.place(), "the camera's transform is singular, projective or not finite; the camera is left out");
    return;
  }
  Matrix camera_to_world = affine_inverse(directive.world_to_camera) * scaling({1.0, 1.0, -1.0});
  const double size = std::cbrt(std::abs(glm::determinant(glm::dmat3(camera_to_world))));
  for (int column = 0; column < 3; ++column) camera_to_world[column] /= size;
  if (!is_usable(camera_to_world)) {
    context.warnings.add(p.place(), "the camera's transform is singular, projective or not finite; the camera is left out");
    return;
  }
  Camera camera;
  camera.name = "camera";
  camera.camera_to_world = Mat4(camera_to_world);
  float degrees = p.number("fov", 90.0F);
  if (const auto half = p.number("halffov")) degrees = 2.0F * *half;
  if (!(degrees > 0.0F && degrees < 180.0F)) p.place().fail("\"fov\" must be above 0 and below 180 degrees");
  camera.field_of_view = degrees * (kPi / 180.0F);
  camera.axis = FieldOfViewAxis::smaller;
  camera.lens_radius = std::max(0.0F, p.number("lensradius", 0.0F)) * static_cast<float>(size);
  // pbrt's focal distance of a million means infinity; without a lens it has no effect.
  camera.focus_distance = p.number("focaldistance", 1e6F) * static_cast<float>(size);
  if (!(camera.focus_distance > 0.0F) || !std::isfinite(camera.focus_distance)) p.place().fail("\"focaldistance\" must be positive");
  for (const char* name : {"screenwindow", "frameaspectratio"}) {
    if (p.find(name) != nullptr) context.warnings.add(p.place(), "the camera's \"" + std::string(name) + "\" is left out");
  }
  for (const char* name : {"shutteropen", "shutterclose"}) p.ignore(name);
  for (const Parameter& parameter : p.own()) {
    if (!parameter.used) context.warnings.add(parameter.place, "the camera has no parameter \"" + parameter.name + "\"");
  }
  scene.cameras.push_back(std::move(camera));
}

}  // namespace

void build_camera(const Description& description, Scene& scene, Context& context) {
  if (description.film) build_film(*description.film, scene, context);
  if (!description.camera) return;
  if (description.camera->type != "perspective")
    context.warnings.add(description.camera->parameters.place(),
                         "the camera \"" + description.camera->type + "\" is shown as a perspective camera");
  build_perspective(*description.camera, scene, context);
}

}  // namespace grove::pbrt
