#include "sampling_options.h"

namespace grove::app {

void add_sampling(CLI::App& verb, SamplingOptions& options) {
  verb.add_option("--lights", options.lights, "How one of many lights is chosen: hierarchy, groups, power or uniform")
      ->type_name("NAME")
      ->capture_default_str();
}

void apply_sampling(const SamplingOptions& options, RenderSettings& settings) {
  settings.lights = light_sampling_from_name(options.lights);
}

}  // namespace grove::app
