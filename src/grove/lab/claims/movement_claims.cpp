// What the review says of scenes that move (sections III.C.3 and IV.A): hierarchies are costly to build anew in every frame.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "grove/lab/animation.h"
#include "grove/lab/claims/claim.h"
#include "grove/lab/claims/figures.h"
#include "grove/lab/text_table.h"

namespace grove {
namespace {

/// Seconds of one policy over an animation.
struct PolicySum {
  double update = 0.0;
  double trace = 0.0;
  [[nodiscard]] double total() const { return update + trace; }
};

Finding check_refit(const Effort& effort) {
  ReportTable table{{"scene", "rays a frame", "policy", "update ms a frame", "trace ms a frame", "sum", "steps a ray, last frame"}, {}};
  std::vector<PlotSeries> totals;
  std::vector<PlotSeries> growth;
  std::vector<std::string> cases;
  std::size_t refit_wins = 0;
  std::size_t automatic_best = 0;
  std::vector<std::string> ratios;
  const unsigned frames = effort.choose(8U, 24U);
  // A hierarchy that is only refitted while its primitives fly apart takes some twenty times as long to trace: few rays are enough.
  const auto few_rays = effort.choose<std::size_t>(1'000, 5'000);
  const auto many_rays = effort.choose<std::size_t>(10'000, 100'000);
  for (const std::string& source : effort.choose<std::vector<std::string>>({"builtin:twist?size=10", "builtin:shatter?size=30"},
                                                                           {"builtin:twist", "builtin:shatter"})) {
    const std::string scene = source.substr(8, source.find('?') - 8);
    for (const std::size_t rays : {few_rays, many_rays}) {
      AnimationSettings settings;
      settings.frames = frames;
      settings.workload.ray_count = rays;
      ProgressReporter progress;
      progress.stop = effort.stop;
      const Animation animation = animate(moving_scene(source), settings, progress);
      effort.check_stop();
      std::map<UpdatePolicy, PolicySum> sums;
      std::map<UpdatePolicy, double> last_steps;
      for (const AnimationRow& row : animation.rows) {
        sums[row.policy].update += row.update.seconds;
        sums[row.policy].trace += row.trace_seconds;
        last_steps[row.policy] = row.nodes_per_ray + row.tests_per_ray;
        if (rays != many_rays) continue;
        const double steps = last_steps[row.policy];
        add_point(growth, fmt::format("{}, {}", scene, name_of(row.policy)), {row.time, steps, steps, steps});
      }
      const double per_frame = 1e3 / frames;
      for (const auto& [policy, sum] : sums) {
        table.rows.push_back({scene, static_cast<double>(rays), std::string(name_of(policy)), per_frame * sum.update, per_frame * sum.trace,
                              per_frame * sum.total(), last_steps[policy]});
        const double total = per_frame * sum.total();
        add_point(totals, std::string(name_of(policy)), {static_cast<double>(cases.size()), total, total, total});
      }
      const double rebuild = sums[UpdatePolicy::rebuild].total();
      refit_wins += sums[UpdatePolicy::refit].total() < rebuild ? 1 : 0;
      const double best = std::ranges::min(std::array{rebuild, sums[UpdatePolicy::refit].total(), sums[UpdatePolicy::rotate].total()});
      automatic_best += sums[UpdatePolicy::automatic].total() < 1.1 * best ? 1 : 0;
      ratios.push_back(
          fmt::format("{} with {} rays {}", scene, with_separators(rays), short_number(rebuild / sums[UpdatePolicy::refit].total())));
      cases.push_back(fmt::format("{}, {} rays", scene, with_separators(rays)));
    }
  }
  Finding finding;
  finding.verdict = verdict_by_cases(refit_wins, cases.size());
  finding.measured = fmt::format(
      "Frame time by rebuilding over that by refitting, updates and rays together: {}. Refitting wins in {} of {}; the automatic policy is "
      "within 10 % of the best of them in {}.",
      fmt::join(ratios, ", "), refit_wins, cases.size(), automatic_best);
  finding.sections.push_back({"Frame time by policy",
                              fmt::format("{} frames, all threads; every hit is checked against a structure built anew.", frames), table,
                              ReportPlot{PlotKind::bar, {"", false, cases}, {"ms a frame"}, totals}});
  finding.sections.push_back(
      {"Nodes and tests a ray over the animation", "", {}, ReportPlot{PlotKind::line, {"time"}, {"nodes + tests a ray"}, growth}});
  return finding;
}

constexpr std::array kClaims{Claim{"refit-against-rebuild",
                                   "Hierarchies are expensive to build for dynamic scenes where they must be updated in every frame.",
                                   "III.C.3, IV.A",
                                   "Two animations by four policies at two numbers of rays a frame: time of updates and rays together. "
                                   "Holds when refitting beats rebuilding in all, fails when "
                                   "rebuilding in every frame beats refitting in all.",
                                   check_refit}};

}  // namespace

std::span<const Claim> movement_claims() {
  return kClaims;
}

}  // namespace grove
