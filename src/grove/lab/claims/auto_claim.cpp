// Whether `auto` picks the structure that turns out to be quickest (not a claim of the review, but of the design).

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "grove/lab/auto_trial.h"
#include "grove/lab/claims/claim.h"
#include "grove/lab/claims/figures.h"
#include "grove/lab/regression.h"
#include "grove/lab/text_table.h"

namespace grove {
namespace {

constexpr std::array kRayCounts{1e6, 1e8, 1e10};
/// A choice that takes at most this much longer is as good as the best: times of the same structure differ by as much from run to run.
constexpr double kAsGood = 0.1;

std::vector<TrialScene> scenes_for(const Effort& effort) {
  const std::size_t rays = effort.ray_count();
  std::vector<TrialScene> scenes = varied_scenes(effort.choose<std::size_t>(10'000, 100'000), RayKind::diffuse, rays);
  const int spheres = effort.choose(5'000, 50'000);
  for (const std::string& source : {std::string("builtin:cornell"), fmt::format("builtin:spheres?size={}", spheres),
                                    fmt::format("builtin:spheres?size={}&layout=clustered", spheres)})
    scenes.push_back(named_scene(source, RayKind::diffuse, rays));
  if (!effort.quick) {
    for (TrialScene& scene : varied_scenes(2'000, RayKind::random, rays)) {
      scene.name += ", small";
      scenes.push_back(std::move(scene));
    }
  }
  return scenes;
}

std::vector<std::string> candidates_for(const TrialScene& scene) {
  std::vector<std::string> specs{"fast",
                                 "fast:quality=low",
                                 "fast:quality=high",
                                 "bvh",
                                 "bvh:arity=8",
                                 "bvh:split=lbvh,arity=8",
                                 "bvh:arity=8,optimize=reinsertion",
                                 "kdtree",
                                 "octree"};
  if (scene.scene.primitive_count() <= 100) specs.emplace_back("brute");
  return specs;
}

Finding check_auto(const Effort& effort) {
  ReportTable table{{"scene", "rays", "auto takes", "the quickest is", "s of auto's", "s of the quickest", "regret"}, {}};
  std::vector<PlotSeries> series;
  std::vector<std::string> names;
  std::size_t picked = 0;
  std::size_t as_good = 0;
  std::vector<double> ratios;
  for (const TrialScene& scene : scenes_for(effort)) {
    effort.check_stop();
    TrialSettings settings = effort.trials();
    settings.build_rounds = 3;
    for (const AutoTrial& trial : try_auto(scene.scene, candidates_for(scene), scene.rays, kRayCounts, settings)) {
      table.rows.push_back({scene.name, short_number(trial.rays), trial.choice.structure, trial.winner, trial.choice_seconds,
                            trial.winner_seconds, percent_more(1.0 + trial.regret())});
      picked += trial.picked_winner() ? 1 : 0;
      as_good += trial.regret() <= kAsGood ? 1 : 0;
      ratios.push_back(1.0 + trial.regret());
      const double regret = 100.0 * trial.regret();
      add_point(series, short_number(1e-6 * trial.rays) + " M rays", {static_cast<double>(names.size()), regret, regret, regret});
    }
    names.push_back(scene.name);
  }
  const auto cases = static_cast<double>(ratios.size());
  Finding finding;
  finding.verdict = static_cast<double>(as_good) >= 0.9 * cases  ? Verdict::holds
                    : static_cast<double>(as_good) < 0.5 * cases ? Verdict::fails
                                                                 : Verdict::mixed;
  finding.measured = fmt::format(
      "Of {} choices {} are the quickest of all candidates and {} within {:.0f} % of it; regret is {} on average (geometric mean) and {} "
      "at worst.",
      ratios.size(), picked, as_good, 100.0 * kAsGood, percent_more(geometric_mean(ratios)),
      percent_more(*std::ranges::max_element(ratios)));
  finding.sections.push_back(
      {"What auto takes, and what is quickest",
       "Time to build and trace that many rays, both on one thread. Regret is by how much longer auto's choice takes.", table,
       ReportPlot{PlotKind::bar, {"", false, names}, {"regret, percent"}, series}});
  return finding;
}

constexpr std::array kClaims{Claim{
    "auto-picks-winner", "From a look at some primitives, auto picks the structure that builds and traces quickest.", "design, section 4",
    "Time to build and trace 1 M, 100 M and 10 G rays with each of nine or ten structures on eight to thirteen scenes. Holds when at least "
    "90 % of the "
    "choices take at most 10 % longer than the quickest, fails when fewer than half do.",
    check_auto}};

}  // namespace

std::span<const Claim> auto_claims() {
  return kClaims;
}

}  // namespace grove
