#pragma once

#include <CLI/App.hpp>
#include <string>

#include "grove/render/render.h"

namespace grove::app {

/// How samples are spent: options of `grove render` that do not change what the picture converges to.
struct SamplingOptions {
  std::string lights = "hierarchy";
};

void add_sampling(CLI::App& verb, SamplingOptions& options);

/// Carries the options over. Throws UsageError for what does not fit together.
void apply_sampling(const SamplingOptions& options, RenderSettings& settings);

}  // namespace grove::app
