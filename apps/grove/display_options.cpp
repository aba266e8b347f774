#include "display_options.h"

#include <CLI/Option.hpp>

#include "grove/base/error.h"
#include "options.h"

namespace grove::app {

void add_display(CLI::App& verb, DisplayOptions& options) {
  in_range(verb.add_option("--exposure", options.settings.exposure, "Stops by which a path-traced .png is brightened")
               ->type_name("STOPS")
               ->capture_default_str(),
           -64.0, 64.0);
  verb.add_option("--tone-map", options.tone_map, "Curve of a path-traced .png: none, filmic or aces")
      ->type_name("NAME")
      ->capture_default_str();
}

void parse_display(DisplayOptions& options) {
  try {
    options.settings.tone_map = tone_map_from_name(options.tone_map);
  } catch (const UsageError& error) {
    throw UsageError("--tone-map: " + std::string(error.what()));
  }
}

}  // namespace grove::app
