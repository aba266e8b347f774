#pragma once

#include <CLI/App.hpp>
#include <string>

#include "grove/render/image/write_png.h"

namespace grove::app {

/// How a path-traced picture is shown in a .png.
struct DisplayOptions {
  std::string tone_map = "aces";
  DisplaySettings settings;  ///< the curve after `parse_display`
};

void add_display(CLI::App& verb, DisplayOptions& options);

/// Throws UsageError for a curve that there is not.
void parse_display(DisplayOptions& options);

}  // namespace grove::app
