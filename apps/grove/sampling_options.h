#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "grove/render/render.h"

namespace grove::app {

/// How samples are spent: options of `grove render` that do not change what the picture converges to.
struct SamplingOptions {
  std::string lights = "hierarchy";
  std::optional<double> noise;
  std::optional<std::uint64_t> min_samples;
  std::optional<double> noise_floor;
  std::optional<double> time_limit;
};

void add_sampling(CLI::App& verb, SamplingOptions& options);

/// Carries the options over. Where `has_samples` is false, nothing was said of the number of samples, and it becomes the most that a noise target or
/// a time limit may want. Throws UsageError for what does not fit together; `has_range`: samples were to be left out.
void apply_sampling(const SamplingOptions& options, bool has_samples, bool has_range, RenderSettings& settings);

}  // namespace grove::app
