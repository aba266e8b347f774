// The forms of octrees that the review describes (sections III.A.1 and III.A.2): two walks and two ways to store; and how deep and empty they become.

#include <fmt/format.h>

#include <array>

#include "grove/lab/claims/claim.h"
#include "grove/lab/claims/figures.h"
#include "grove/lab/octree_trial.h"
#include "grove/lab/regression.h"
#include "grove/lab/text_table.h"

namespace grove {
namespace {

Finding check_ray_generator(const Effort& effort) {
  ReportTable table{{"scene", "walk", "nodes a ray", "tests a ray", "ns a ray", "speed against top-down"}, {}};
  std::vector<PlotSeries> series;
  std::vector<std::string> names;
  std::vector<double> climbing;
  std::vector<double> linked;
  std::vector<double> climbing_nodes;
  std::vector<double> linked_nodes;
  std::size_t faster = 0;
  for (const ScatteredPrimitive primitive : {ScatteredPrimitive::spheres, ScatteredPrimitive::triangles}) {
    for (const double skew : {1.0, 2.0, 4.0}) {
      effort.check_stop();
      const ScatterSettings settings{primitive, effort.choose<std::size_t>(10'000, 200'000), skew};
      const GeometryPointer geometry = scatter(settings);
      const std::vector<Ray> rays = rays_inside({Vec3(0.0F), Vec3(1.0F)}, effort.ray_count(), 2);
      const OctreeContender contenders[] = {{"top-down", {}},
                                            {"neighbour by climbing", {}, OctreeWalk::neighbour},
                                            {"neighbour by links", {}, OctreeWalk::neighbour, UseMailbox::yes, true}};
      const std::vector<OctreeTrial> trials = try_octrees(geometry, contenders, rays, effort.rounds());
      const std::string scene = fmt::format("{}, skew {}", name_of(primitive), skew);
      for (const OctreeTrial& trial : trials) {
        const Spread speed = spread_of(ratios_by_round(trials[0].nanoseconds, trial.nanoseconds));
        table.rows.push_back(
            {scene, trial.name, trial.nodes_visited, trial.tests, spread_of(trial.nanoseconds).median, spread_text(speed)});
        add_point(series, trial.name, spread_point(static_cast<double>(names.size()), speed));
      }
      climbing.push_back(spread_of(ratios_by_round(trials[0].nanoseconds, trials[1].nanoseconds)).median);
      linked.push_back(spread_of(ratios_by_round(trials[0].nanoseconds, trials[2].nanoseconds)).median);
      climbing_nodes.push_back(trials[1].nodes_visited / trials[0].nodes_visited);
      linked_nodes.push_back(trials[2].nodes_visited / trials[0].nodes_visited);
      faster += std::max(climbing.back(), linked.back()) > 1.0 ? 1 : 0;
      names.push_back(scene);
    }
  }
  Finding finding;
  finding.verdict = verdict_by_cases(faster, names.size());
  finding.measured = fmt::format(
      "By neighbours, rays go {} times as fast as from the top when neighbours are found by climbing, {} times by stored links (geometric "
      "means); one of "
      "them is faster in {} of {} scenes.",
      short_number(geometric_mean(climbing)), short_number(geometric_mean(linked)), faster, names.size());
  finding.why = fmt::format(
      "For the same tests they visit {} and {} times the nodes: each next cell is found from a parent or a neighbour down to a leaf, where "
      "the walk from the top goes on from what is on its stack.",
      short_number(geometric_mean(climbing_nodes)), short_number(geometric_mean(linked_nodes)));
  finding.sections.push_back({"Speed of the ray generator against the walk from the top",
                              "Both stop at the first leaf with a hit in it, so early termination favours neither.", table,
                              ReportPlot{PlotKind::bar, {"", false, names}, {"speed against top-down"}, series}});
  return finding;
}

Finding check_one_parent(const Effort& effort) {
  const std::vector<std::string> specs{"octree", "octree:store=inner"};
  ReportTable table = trial_table();
  std::vector<PlotSeries> series;
  std::vector<std::string> names;
  std::vector<double> memory;
  std::vector<double> speed;
  std::vector<double> tests;
  std::size_t exact = 0;
  for (TrialScene& scene :
       varied_scenes(effort.choose<std::size_t>(10'000, 100'000), RayKind::diffuse, effort.choose<std::size_t>(2'000, 10'000))) {
    const std::vector<StructureTrial> trials = try_structures(scene.scene, specs, scene.rays, effort.trials());
    add_trials(table, scene.name, trials);
    memory.push_back(static_cast<double>(trials[1].statistics.bytes) / static_cast<double>(trials[0].statistics.bytes));
    tests.push_back(trials[1].tests / trials[0].tests);
    const Spread ratio = speed_ratio(trials[1], trials[0]);
    speed.push_back(ratio.median);
    exact += trials[1].statistics.references == trials[1].statistics.primitives ? 1 : 0;
    const auto at = static_cast<double>(names.size());
    add_point(series, "memory", {at, memory.back(), memory.back(), memory.back()});
    add_point(series, "speed", spread_point(at, ratio));
    names.push_back(scene.name);
  }
  Finding finding;
  finding.verdict = verdict_by_cases(exact, names.size());
  finding.measured = fmt::format(
      "Each primitive has one parent in {} of {} scenes. That takes {} of the memory of references in all leaves, {} times the tests and "
      "{} of the speed (geometric "
      "means): what lies across a plane near the top is tested by every ray.",
      exact, names.size(), short_number(geometric_mean(memory)), short_number(geometric_mean(tests)), short_number(geometric_mean(speed)));
  finding.sections.push_back({"One parent against references in all leaves", "", table,
                              ReportPlot{PlotKind::bar, {"", false, names}, {"against references in leaves", true}, series}});
  return finding;
}

Finding check_empty(const Effort& effort) {
  ReportTable table{{"skew", "structure", "depth", "cells", "empty cells", "references a primitive", "nodes a ray", "tests a ray"}, {}};
  std::vector<PlotSeries> series;
  std::vector<double> depths;
  std::vector<double> empty;
  TrialSettings settings = effort.trials();
  settings.rounds = 1;
  for (const double skew : {1.0, 1.5, 2.0, 3.0, 4.0}) {
    const auto count = effort.choose<std::size_t>(20'000, 200'000);
    const TrialScene scene = scattered_scene({ScatteredPrimitive::triangles, count, skew}, effort.ray_count());
    // Deep enough that depth does not end before leaves are small.
    const std::vector<std::string> deep{"octree:max-depth=16", "octree:split=octree-r"};
    const std::vector<StructureTrial> trials = try_structures(scene.scene, deep, scene.rays, settings);
    for (const StructureTrial& trial : trials) {
      const StructureStatistics& statistics = trial.statistics;
      const double interior = static_cast<double>(statistics.nodes - statistics.leaves);
      // Each interior node has eight octants; all but the root are octants themselves.
      const double cells = 8.0 * interior - (interior - 1.0);
      const double share = 1.0 - static_cast<double>(statistics.leaves) / cells;
      table.rows.push_back({skew, trial.structure, static_cast<double>(statistics.depth), cells, share,
                            static_cast<double>(statistics.references) / scene.primitives(), trial.nodes, trial.tests});
      add_point(series, trial.structure, {skew, share, share, share});
      if (&trial == trials.data()) {
        depths.push_back(statistics.depth);
        empty.push_back(share);
      }
    }
  }
  Finding finding;
  const bool deeper = depths.back() > depths.front();
  const bool emptier = empty.back() > empty.front();
  finding.verdict = deeper && emptier ? Verdict::holds : deeper || emptier ? Verdict::mixed : Verdict::fails;
  finding.measured = fmt::format("From even to skew 4 the octree grows from {} to {} levels, and from {:.0f} % to {:.0f} % empty cells.",
                                 depths.front(), depths.back(), 100.0 * empty.front(), 100.0 * empty.back());
  finding.sections.push_back({"Empty cells as scenes become uneven", "At most 16 levels.", table,
                              ReportPlot{PlotKind::line, {"skew"}, {"share of cells that are empty"}, series}});
  return finding;
}

constexpr std::array kClaims{
    Claim{"octree-one-parent",
          "References can be kept in inner nodes instead, so that each object has exactly one parent: the smallest node that encloses it.",
          "III.A.1",
          "References, memory, tests and speed of both stores on five kinds of scenes. Holds when there are as many references as "
          "primitives everywhere; the "
          "price is reported.",
          check_one_parent},
    Claim{"octree-ray-generator",
          "The ray generator, which goes from cell to neighbouring cell, can be more time efficient than descending from the root.",
          "III.A.2",
          "The same octree by both walks, neighbours found by climbing and by stored links. Holds when either is faster in all scenes, "
          "fails when "
          "neither is in any.",
          check_ray_generator},
    Claim{"octree-deep-and-empty", "Where geometry is uneven, uniform partitioning leads to deep trees with many empty nodes.", "III.A.3",
          "Depth and the share of empty cells as triangles are scattered more and more unevenly. Holds when both grow.", check_empty}};

}  // namespace

std::span<const Claim> octree_form_claims() {
  return kClaims;
}

}  // namespace grove
