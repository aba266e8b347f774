#include "grove/render/saved/picture_identity.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "grove/base/hash.h"
#include "grove/render/render.h"
#include "grove/render/view.h"
#include "grove/scene/fingerprint.h"

namespace grove {
namespace {

std::string hexadecimal(std::uint64_t number) {
  constexpr std::size_t kDigits = 16;
  std::array<char, kDigits> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number, 16).ptr;
  const std::string text(digits.data(), end);
  return std::string(kDigits - text.size(), '0') + text;
}

/// The shortest text that names this very number.
std::string exact(float number) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), number).ptr};
}

std::uint64_t fingerprint(const Camera& camera) {
  const auto& [name, camera_to_world, field_of_view, axis, lens_radius, focus_distance] = camera;
  Hash hash;
  hash.add(camera_to_world);
  hash.add(field_of_view);
  hash.add(axis);
  hash.add(lens_radius);
  hash.add(focus_distance);
  return hash.value();
}

}  // namespace

PictureIdentity picture_identity(const Scene& scene, const SceneAccelerator& accelerator, const RenderSettings& settings) {
  const View view = choose_view(scene, settings);
  PictureIdentity picture{{
      {"version", GROVE_VERSION},
      {"scene contents", hexadecimal(fingerprint(scene))},
      {"width", std::to_string(view.width)},
      {"height", std::to_string(view.height)},
      {"integrator", std::string(integrator_names()[static_cast<std::size_t>(settings.integrator)])},
      {"max-depth", std::to_string(settings.max_depth)},
      {"seed", std::to_string(settings.seed)},
      {"camera", hexadecimal(fingerprint(view.camera))},
      {"ambient occlusion distance", exact(settings.ao_distance)},
      {"indirect clamp", exact(settings.indirect_clamp)},
      {"lights", std::string(light_sampling_names()[static_cast<std::size_t>(settings.lights)])},
  }};
  // Of all integrators, this one shows the structure.
  if (settings.integrator == Integrator::cost) picture.facts.push_back({"structure", accelerator.spec()});
  return picture;
}

std::string fact_of(const PictureIdentity& picture, const std::string& name) {
  const auto fact = std::ranges::find(picture.facts, name, &PictureIdentity::Fact::name);
  return fact == picture.facts.end() ? std::string() : fact->value;
}

std::string difference(const PictureIdentity& there, const PictureIdentity& here) {
  const auto told = [](const std::string& value) { return value.empty() ? std::string("none") : value; };
  for (const PictureIdentity* facts : {&here, &there}) {
    for (const PictureIdentity::Fact& fact : facts->facts) {
      const std::string one = fact_of(there, fact.name);
      const std::string other = fact_of(here, fact.name);
      if (one != other) return fact.name + " " + told(one) + " instead of " + told(other);
    }
  }
  return {};
}

}  // namespace grove
