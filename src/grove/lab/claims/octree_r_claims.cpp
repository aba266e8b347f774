// What the review says of octree-R (section IV.B, after Whang et al. 1995): its gain over the octree, and how many planes are worth trying.

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "grove/lab/claims/claim.h"
#include "grove/lab/claims/figures.h"
#include "grove/lab/octree_trial.h"
#include "grove/lab/text_table.h"

namespace grove {
namespace {

OctreeSettings octree_r(OctreeRSearch search) {
  return {.split = OctreeSplit::octree_r, .search = search};
}

std::vector<std::size_t> sizes_of(const Effort& effort) {
  return effort.choose<std::vector<std::size_t>>({10'000}, {10'000, 100'000, 1'000'000});
}

Finding check_gain(const Effort& effort) {
  ReportTable table{{"primitives", "count", "skew", "octree-R by", "leaves", "gain in tests", "gain in time"}, {}};
  std::vector<PlotSeries> in_time;
  std::vector<PlotSeries> in_tests;
  std::vector<double> gains;
  std::vector<double> test_gains;
  std::vector<double> event_gains;
  std::size_t in_range = 0;
  for (const std::size_t count : sizes_of(effort)) {
    for (const ScatteredPrimitive primitive : {ScatteredPrimitive::spheres, ScatteredPrimitive::triangles}) {
      for (const double skew : effort.choose<std::vector<double>>({1.0, 2.0, 4.0}, {1.0, 1.5, 2.0, 3.0, 4.0})) {
        effort.check_stop();
        // A million takes long; three skews say how it goes on.
        if (count >= 1'000'000 && (skew == 1.5 || skew == 3.0)) continue;
        const GeometryPointer geometry = scatter({primitive, count, skew});
        const std::vector<Ray> rays = rays_inside({Vec3(0.0F), Vec3(1.0F)}, effort.choose<std::size_t>(10'000, 20'000), 2);
        const std::uint64_t leaves = count_octree_leaves(geometry, {});
        const int builds = count >= 1'000'000 ? 5 : 8;
        std::vector<OctreeContender> contenders{{"octree", {}}};
        contenders.push_back({"candidates", match_leaves(geometry, octree_r(OctreeRSearch::candidates), leaves, builds)});
        contenders.push_back({"events", match_leaves(geometry, octree_r(OctreeRSearch::events), leaves, builds)});
        // Joint planes of a million take minutes; they gain no more than candidates on fewer.
        if (count < 1'000'000) contenders.push_back({"joint", match_leaves(geometry, octree_r(OctreeRSearch::joint), leaves, builds)});
        const std::vector<OctreeTrial> trials = try_octrees(geometry, contenders, rays, effort.rounds());
        for (std::size_t i = 1; i < trials.size(); ++i) {
          const OctreeTrial& trial = trials[i];
          std::vector<double> ratios = ratios_by_round(trials[0].nanoseconds, trial.nanoseconds);
          for (double& ratio : ratios) ratio = 100.0 * (ratio - 1.0);
          const Spread gain = spread_of(ratios);
          const double test_gain = 100.0 * (trials[0].tests / trial.tests - 1.0);
          table.rows.push_back({std::string(name_of(primitive)), static_cast<double>(count), skew, trial.name,
                                static_cast<double>(trial.leaves), fmt::format("{:+.0f} %", test_gain),
                                fmt::format("{:+.0f} % ({:+.0f} to {:+.0f})", gain.median, gain.min, gain.max)});
          const std::string series = fmt::format("{} {}, {}", with_separators(count), name_of(primitive), trial.name);
          add_point(in_time, series, spread_point(skew, gain));
          add_point(in_tests, series, {skew, test_gain, test_gain, test_gain});
          if (i == 1) {
            gains.push_back(gain.median);
            test_gains.push_back(test_gain);
            in_range += gain.median >= 4.0 && gain.median <= 47.0 ? 1 : 0;
          } else if (i == 2) {
            event_gains.push_back(gain.median);
          }
        }
      }
    }
  }
  const auto [least, most] = std::ranges::minmax(gains);
  const auto [least_test, most_test] = std::ranges::minmax(test_gains);
  const auto [least_event, most_event] = std::ranges::minmax(event_gains);
  Finding finding;
  finding.verdict = verdict_by_cases(in_range, gains.size());
  finding.measured = fmt::format(
      "With as many leaves octree-R as published lets {:+.0f} % to {:+.0f} % more rays through in the same time, within 4 % to 47 % in {} "
      "of {} cases; the octree makes {:+.0f} % to {:+.0f} % more tests. "
      "With all events it is {:+.0f} % to {:+.0f} % in time.",
      least, most, in_range, gains.size(), least_test, most_test, least_event, most_event);
  finding.sections.push_back({"Gain of octree-R in time over skew",
                              "At as many leaves as the octree has, within a few percent; one thread.", table,
                              ReportPlot{PlotKind::line, {"skew"}, {"gain in time, %"}, in_time}});
  finding.sections.push_back({"Gain in tests over skew", "", {}, ReportPlot{PlotKind::line, {"skew"}, {"gain in tests, %"}, in_tests}});
  return finding;
}

Finding check_candidates(const Effort& effort) {
  const std::vector<std::uint32_t> counts = effort.choose<std::vector<std::uint32_t>>({1, 2, 4, 8, 16}, {1, 2, 4, 8, 16, 32, 64});
  ReportTable table{{"scene", "candidates", "build ms", "leaves", "nodes a ray", "tests a ray", "ns a ray", "speed against one candidate"},
                    {}};
  std::vector<PlotSeries> series;
  std::size_t enough = 0;
  std::size_t cases = 0;
  std::vector<std::string> best_counts;
  for (const ScatteredPrimitive primitive : {ScatteredPrimitive::spheres, ScatteredPrimitive::triangles}) {
    for (const double skew : {1.0, 2.0, 4.0}) {
      effort.check_stop();
      const GeometryPointer geometry = scatter({primitive, effort.choose<std::size_t>(10'000, 100'000), skew});
      const std::vector<Ray> rays = rays_inside({Vec3(0.0F), Vec3(1.0F)}, effort.choose<std::size_t>(10'000, 20'000), 2);
      std::vector<OctreeContender> contenders;
      for (const std::uint32_t count : counts) {
        OctreeSettings settings = octree_r(OctreeRSearch::candidates);
        settings.candidate_count = count;
        contenders.push_back({fmt::format("{}", count), settings});
      }
      const std::vector<OctreeTrial> trials = try_octrees(geometry, contenders, rays, effort.rounds());
      const std::string scene = fmt::format("{}, skew {}", name_of(primitive), skew);
      double best = 0.0;
      double at_eight = 0.0;
      std::uint32_t best_count = 0;
      for (std::size_t i = 0; i < trials.size(); ++i) {
        const OctreeTrial& trial = trials[i];
        const Spread speed = spread_of(ratios_by_round(trials[0].nanoseconds, trial.nanoseconds));
        table.rows.push_back({scene, static_cast<double>(counts[i]), 1e3 * trial.build_seconds, static_cast<double>(trial.leaves),
                              trial.nodes_visited, trial.tests, spread_of(trial.nanoseconds).median, spread_text(speed)});
        add_point(series, scene, spread_point(counts[i], speed));
        if (counts[i] == 8) at_eight = speed.median;
        if (speed.median > best) {
          best = speed.median;
          best_count = counts[i];
        }
      }
      best_counts.push_back(fmt::format("{} ({})", best_count, scene));
      enough += at_eight > 0.97 * best ? 1 : 0;
      ++cases;
    }
  }
  Finding finding;
  finding.verdict = verdict_by_cases(enough, cases);
  finding.measured =
      fmt::format("Eight candidates an axis are within 3 % of the fastest count in {} of {} cases; the fastest counts are {}.", enough,
                  cases, fmt::join(best_counts, ", "));
  finding.sections.push_back({"Speed over the number of candidates", "Octree-R stops where its cost says so.", table,
                              ReportPlot{PlotKind::line, {"candidates", true}, {"speed against one candidate"}, series}});
  return finding;
}

constexpr std::array kClaims{
    Claim{"octree-r-gain", "Octree-R is 4 % to 47 % faster than the octree.", "IV.B",
          "Octree-R with as many leaves as an octree has, on spheres and triangles scattered more and more unevenly. Holds when the gain "
          "in time of the published "
          "search is within 4 % to 47 % in all cases, fails when it is in none.",
          check_gain},
    Claim{"octree-r-candidates",
          "Several planes, equally spaced between the medians, are tried; their number is to be decided through tests.", "IV.B",
          "Speed of octree-R by number of candidates, 1 to 64. Holds when the eight that Grove takes are within 3 % of the fastest in all "
          "cases.",
          check_candidates}};

}  // namespace

std::span<const Claim> octree_r_claims() {
  return kClaims;
}

}  // namespace grove
