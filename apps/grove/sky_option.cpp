#include "sky_option.h"

#include <fmt/format.h>

#include <CLI/Option.hpp>

#include "grove/base/error.h"
#include "options.h"

namespace grove::app {

void add_sky(CLI::App& verb, SkyOption& option) {
  verb.add_option("--sky", option.text, "Light of this radiance from all around, in place of the scene's environment; 0,0,0 is none")
      ->type_name("r,g,b");
}

void parse_sky(SkyOption& option) {
  if (option.text.empty()) return;
  const Vec3 radiance = parse_vector("--sky", option.text, "r,g,b");
  if (radiance.x < 0.0F || radiance.y < 0.0F || radiance.z < 0.0F) {
    throw UsageError(fmt::format("--sky: '{}' has a negative number; radiance is 0 or more", option.text));
  }
  option.radiance = radiance;
}

void set_sky(const SkyOption& option, Scene& scene) {
  if (!option.radiance) return;
  scene.environment = {};
  scene.environment.radiance = *option.radiance;
}

}  // namespace grove::app
