#pragma once

#include <CLI/App.hpp>
#include <string>

#include "console.h"
#include "grove/render/denoise/denoise.h"

namespace grove::app {

/// What is done against noise.
struct DenoiseOptions {
  std::string text = "off";
  Denoise way = Denoise::off;  ///< after `parse_denoise`
};

void add_denoise(CLI::App& verb, DenoiseOptions& options);

/// Has a render gather what the filter needs. Throws UsageError for a way that there is not, and for pictures that are not light.
void parse_denoise(DenoiseOptions& options, RenderSettings& settings);

/// Filters a still picture, where that is asked for; returns the seconds that it took.
double denoise_still(const DenoiseOptions& options, RenderResult& result, const Console& console);

}  // namespace grove::app
