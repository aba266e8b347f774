// What the review says of parallel construction (section IV.A): binning in parallel, and local octrees that are merged into one.

#include <fmt/format.h>
#include <oneapi/tbb/info.h>

#include <algorithm>
#include <array>

#include "grove/lab/claims/claim.h"
#include "grove/lab/claims/figures.h"
#include "grove/lab/regression.h"
#include "grove/lab/text_table.h"

namespace grove {
namespace {

unsigned all_threads() {
  return static_cast<unsigned>(oneapi::tbb::info::default_concurrency());
}

/// Build times of the same structures by one thread and by all, round by round.
struct ByThreads {
  std::vector<StructureTrial> one;
  std::vector<StructureTrial> all;
};

ByThreads build_by_threads(const TrialScene& scene, std::span<const std::string> specs, const Effort& effort) {
  TrialSettings settings = effort.trials();
  settings.rounds = 1;
  ByThreads result;
  for (unsigned round = 0; round < effort.choose(3U, 5U); ++round) {
    for (const bool all : {false, true}) {
      settings.build_threads = all ? all_threads() : 1;
      std::vector<StructureTrial> trials = try_structures(scene.scene, specs, scene.rays, settings);
      std::vector<StructureTrial>& into = all ? result.all : result.one;
      if (into.empty()) {
        into = std::move(trials);
      } else {
        for (std::size_t i = 0; i < specs.size(); ++i) into[i].build_seconds.push_back(trials[i].build_seconds.front());
      }
    }
  }
  return result;
}

Finding check_binning(const Effort& effort) {
  const std::vector<std::string> specs{"bvh", "bvh:split=sweep"};
  ReportTable table{{"scene", "binned ms, one thread", "all threads", "speed-up", "sweep ms, all threads", "sweep / binned",
                     "cost of binned / sweep", "steps a ray, binned / sweep"},
                    {}};
  std::vector<PlotSeries> series;
  std::vector<std::string> names;
  std::vector<double> speed_ups;
  std::vector<double> costs;
  for (const TrialScene& scene : varied_scenes(effort.choose<std::size_t>(60'000, 500'000), RayKind::diffuse, effort.ray_count())) {
    const ByThreads times = build_by_threads(scene, specs, effort);
    const Spread speed_up = spread_of(ratios_by_round(times.one[0].build_seconds, times.all[0].build_seconds));
    const double cost = times.all[0].statistics.expected_cost / times.all[1].statistics.expected_cost;
    speed_ups.push_back(speed_up.median);
    costs.push_back(cost);
    table.rows.push_back({scene.name, spread_text(spread_of(times.one[0].build_seconds), 1e3),
                          spread_text(spread_of(times.all[0].build_seconds), 1e3), spread_text(speed_up),
                          1e3 * spread_of(times.all[1].build_seconds).median, spread_text(build_ratio(times.all[1], times.all[0])), cost,
                          times.all[0].steps() / times.all[1].steps()});
    add_point(series, "speed-up", spread_point(static_cast<double>(names.size()), speed_up));
    add_point(series, "cost against exact sweep", {static_cast<double>(names.size()), cost, cost, cost});
    names.push_back(scene.name);
  }
  const double speed_up = geometric_mean(speed_ups);
  const double cost = geometric_mean(costs);
  Finding finding;
  const bool faster = speed_up > 0.8 * all_threads();
  finding.verdict = faster && cost < 1.05 ? Verdict::holds : speed_up < 1.1 ? Verdict::fails : Verdict::mixed;
  finding.measured =
      fmt::format("{} threads bin {} times as fast as one, and the hierarchies cost {} against those of the exact sweep (geometric means).",
                  all_threads(), short_number(speed_up), percent_more(cost));
  finding.sections.push_back({"Binning by one thread and by all", "The same tree, bit for bit, for any number of threads.", table,
                              ReportPlot{PlotKind::bar, {"", false, names}, {"ratio"}, series}});
  return finding;
}

Finding check_merge(const Effort& effort) {
  const std::vector<std::string> specs{"octree", "octree:build=merge"};
  ReportTable table{{"scene", "build", "one thread, ms", "all threads, ms", "speed-up", "nodes", "references", "against build=subtree"},
                    {}};
  std::vector<PlotSeries> series;
  std::vector<std::string> names;
  std::vector<double> speed_ups;
  std::vector<double> against;
  std::size_t same = 0;
  for (const std::string source : {"spheres?shape=triangles&", "mount?", "tree?", "stadium?"}) {
    const auto size = effort.choose<std::size_t>(60'000, 500'000);
    const TrialScene scene = named_scene(fmt::format("builtin:{}triangles={}", source, size), RayKind::random, 1000);
    const ByThreads times = build_by_threads(scene, specs, effort);
    for (std::size_t i = 0; i < specs.size(); ++i) {
      const Spread speed_up = spread_of(ratios_by_round(times.one[i].build_seconds, times.all[i].build_seconds));
      const Spread ratio = build_ratio(times.all[i], times.all[0]);
      table.rows.push_back({source.substr(0, source.find('?')), specs[i] == "octree" ? "subtree" : "merge",
                            1e3 * spread_of(times.one[i].build_seconds).median, 1e3 * spread_of(times.all[i].build_seconds).median,
                            spread_text(speed_up), static_cast<double>(times.all[i].statistics.nodes),
                            static_cast<double>(times.all[i].statistics.references), spread_text(ratio)});
      add_point(series, i == 0 ? "subtrees" : "merged", spread_point(static_cast<double>(names.size()), speed_up));
      if (i == 1) {
        speed_ups.push_back(speed_up.median);
        against.push_back(ratio.median);
      }
    }
    const auto alike = [](const StructureStatistics& a, const StructureStatistics& b) {
      return a.nodes == b.nodes && a.leaves == b.leaves && a.references == b.references && a.expected_cost == b.expected_cost;
    };
    same += alike(times.all[0].statistics, times.all[1].statistics) && alike(times.one[1].statistics, times.all[1].statistics) ? 1 : 0;
    names.push_back(source.substr(0, source.find('?')));
  }
  const double speed_up = geometric_mean(speed_ups);
  Finding finding;
  finding.verdict = same == names.size() && speed_up > 0.7 * all_threads() ? Verdict::holds
                    : speed_up < 1.1                                       ? Verdict::fails
                                                                           : Verdict::mixed;
  finding.measured = fmt::format(
      "Octrees of subsets, merged, are the octree of all primitives in {} of {} scenes. {} threads build them {} times as fast as one; "
      "building by subtrees takes {} of the time of merging (geometric means).",
      same, names.size(), all_threads(), short_number(speed_up), short_number(1.0 / geometric_mean(against)));
  finding.sections.push_back({"Building octrees by one thread and by all", "", table,
                              ReportPlot{PlotKind::bar, {"", false, names}, {"speed-up by all threads"}, series}});
  return finding;
}

constexpr std::array kClaims{
    Claim{
        "local-octrees-merged",
        "Octrees are built in parallel by giving each processor a subset of the geometry and merging the local octrees into a global one.",
        "IV.A",
        "Build time by one thread and by all, and whether the merged tree is the one built at once. Holds when it is in all scenes and the "
        "speed-up reaches 70 % of the threads, "
        "fails when threads do not help.",
        check_merge},
    Claim{"parallel-binning", "Binning in parallel significantly reduces construction time of hierarchies.", "IV.A",
          "Build time by one thread and by all, and the cost of the result against the exact sweep. Holds when the speed-up reaches 80 % "
          "of the threads at no more than 5 % "
          "higher cost, fails when threads do not help.",
          check_binning}};

}  // namespace

std::span<const Claim> construction_claims() {
  return kClaims;
}

}  // namespace grove
