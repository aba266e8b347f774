#pragma once

#include <string>

#include "grove/lab/comparison.h"
#include "interrupts.h"
#include "options.h"
#include "trial_builder.h"

namespace grove::app {

/// What `grove compare --scale` asks for besides what a comparison does.
struct ScaleOptions {
  bool is_asked = false;
  std::string sizes;  ///< empty: 1k, 3k, 10k, … up to `largest`
  std::string largest = "10M";
};

/// Runs the study and returns the exit code. `settings` are those of the comparison: structures, rays (one kind), count, seed and rounds are taken from there where they are
/// not what they are by default.
int run_scale(const ScaleOptions& scale, const CommonOptions& common, const ComparisonSettings& settings, const BuildLimits& limits,
              Interrupts& interrupts);

}  // namespace grove::app
