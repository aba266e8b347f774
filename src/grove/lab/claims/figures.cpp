#include "grove/lab/claims/figures.h"

#include <fmt/format.h>

#include <algorithm>

#include "grove/lab/text_table.h"

namespace grove {

std::string spread_text(const Spread& spread, double scale) {
  return fmt::format("{} ({}–{})", short_number(scale * spread.median), short_number(scale * spread.min), short_number(scale * spread.max));
}

std::string percent_more(double ratio) {
  return fmt::format("{}{:.0f} %", ratio < 1.0 ? "−" : "+", 100.0 * std::abs(ratio - 1.0));
}

ReportTable trial_table() {
  return {{"scene", "structure", "build ms", "MiB", "references", "depth", "expected cost", "nodes a ray", "tests a ray", "ns a ray",
           "speed against the first"},
          {}};
}

void add_trials(ReportTable& table, const std::string& scene, std::span<const StructureTrial> trials) {
  for (const StructureTrial& trial : trials) {
    table.rows.push_back({scene, trial.structure, 1e3 * spread_of(trial.build_seconds).median,
                          static_cast<double>(trial.statistics.bytes) * 0x1p-20, static_cast<double>(trial.statistics.references),
                          static_cast<double>(trial.statistics.depth), trial.statistics.expected_cost, trial.nodes, trial.tests,
                          spread_of(trial.nanoseconds).median, spread_text(speed_ratio(trial, trials.front()))});
  }
}

void SceneContest::add(const std::string& scene, std::span<const StructureTrial> trials) {
  add_trials(table, scene, trials);
  speed.resize(trials.size());
  steps.resize(trials.size());
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const Spread ratio = speed_ratio(trials[i], trials[base]);
    speed[i].push_back(ratio.median);
    steps[i].push_back(trials[i].steps() / trials[base].steps());
    add_point(speeds, trials[i].structure, spread_point(static_cast<double>(scenes.size()), ratio));
  }
  scenes.push_back(scene);
}

void add_point(std::vector<PlotSeries>& series, const std::string& name, const PlotPoint& point) {
  const auto found = std::ranges::find(series, name, &PlotSeries::name);
  PlotSeries& one = found != series.end() ? *found : series.emplace_back(PlotSeries{name, {}});
  one.points.push_back(point);
}

}  // namespace grove
