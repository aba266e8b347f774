#pragma once

#include <string>
#include <vector>

#include "grove/lab/report_section.h"
#include "grove/lab/spread.h"
#include "grove/lab/structure_trial.h"

namespace grove {

/// "1.23 (1.20–1.31)".
[[nodiscard]] std::string spread_text(const Spread& spread, double scale = 1.0);

/// "+12 %", "−3 %" for a ratio of 1.12, 0.97.
[[nodiscard]] std::string percent_more(double ratio);

[[nodiscard]] inline PlotPoint spread_point(double x, const Spread& spread) {
  return {x, spread.median, spread.min, spread.max};
}

/// Of the rates of two structures on the same rays: how many times as many rays go through `other` in the same time.
[[nodiscard]] inline Spread speed_ratio(const StructureTrial& other, const StructureTrial& base) {
  return spread_of(ratios_by_round(base.nanoseconds, other.nanoseconds));
}

/// How many times as long `other` takes to build.
[[nodiscard]] inline Spread build_ratio(const StructureTrial& other, const StructureTrial& base) {
  return spread_of(ratios_by_round(other.build_seconds, base.build_seconds));
}

/// A table of trials: scene, structure, build ms, MiB, references, depth, expected cost, nodes, tests, nanoseconds, speed against the first.
[[nodiscard]] ReportTable trial_table();
void add_trials(ReportTable& table, const std::string& scene, std::span<const StructureTrial> trials);

/// What structures do on several scenes, against one of them.
struct SceneContest {
  std::size_t base = 0;  ///< its number among the structures
  ReportTable table = trial_table();
  std::vector<std::string> scenes = {};
  /// By structure, then by scene; medians for speed.
  std::vector<std::vector<double>> speed = {};
  std::vector<std::vector<double>> steps = {};
  std::vector<PlotSeries> speeds = {};  ///< over the scenes, as categories

  void add(const std::string& scene, std::span<const StructureTrial> trials);
};

/// Appends a point to the series of that name, which is made where there is none.
void add_point(std::vector<PlotSeries>& series, const std::string& name, const PlotPoint& point);

}  // namespace grove
