// What the review says of octrees as a whole (section III.A): that they discard geometry, on which scenes they are good, how fast they are built and what they hold.

#include <fmt/format.h>

#include <array>

#include "grove/lab/claims/claim.h"
#include "grove/lab/claims/figures.h"
#include "grove/lab/regression.h"
#include "grove/lab/text_table.h"

namespace grove {
namespace {

Finding check_discards(const Effort& effort) {
  const std::vector<std::size_t> counts =
      effort.choose<std::vector<std::size_t>>({1'000, 4'000, 16'000, 64'000}, {1'000, 10'000, 100'000, 1'000'000});
  const std::vector<std::string> specs{"octree", "bvh", "kdtree"};
  ReportTable table{{"spheres", "tests a ray, brute", "octree", "nodes, octree", "tests, bvh", "tests, kdtree", "times as fast as brute"},
                    {}};
  std::vector<PlotSeries> series;
  std::vector<double> sizes;
  std::vector<double> tests;
  for (const std::size_t count : counts) {
    const TrialScene scene = scattered_scene({.count = count}, effort.ray_count());
    const std::vector<StructureTrial> trials = try_structures(scene.scene, specs, scene.rays, effort.trials());
    // Brute force tests every primitive; its time is taken with rays enough for about ten million tests.
    const std::size_t few = std::clamp<std::size_t>(10'000'000 / count, 8, scene.rays.size());
    TrialSettings settings = effort.trials();
    settings.rounds = 3;
    const std::vector<std::string> against{"octree", "brute"};
    const std::vector<StructureTrial> brute = try_structures(scene.scene, against, std::span(scene.rays).first(few), settings);
    const auto n = static_cast<double>(count);
    sizes.push_back(n);
    tests.push_back(trials[0].tests);
    table.rows.push_back({n, brute[1].tests, trials[0].tests, trials[0].nodes, trials[1].tests, trials[2].tests,
                          spread_text(speed_ratio(brute[0], brute[1]))});
    add_point(series, "brute", {n, brute[1].tests, brute[1].tests, brute[1].tests});
    for (const StructureTrial& trial : trials) add_point(series, trial.structure, {n, trial.tests, trial.tests, trial.tests});
  }
  const PowerLaw law = fit_power_law(sizes, tests);
  const double share = tests.back() / sizes.back();
  Finding finding;
  finding.verdict = law.exponent < 0.4 && share < 0.01 ? Verdict::holds : law.exponent < 0.8 ? Verdict::mixed : Verdict::fails;
  finding.measured =
      fmt::format("Of {} spheres a ray tests {} with an octree, {} of all; tests grow as n^{:.2f} where brute force has n^1.",
                  with_separators(counts.back()), short_number(tests.back()), short_number(share), law.exponent);
  finding.sections.push_back(
      {"Tests a ray over the number of spheres", "", table, ReportPlot{PlotKind::line, {"spheres", true}, {"tests a ray", true}, series}});
  return finding;
}

/// Steps and speed of the octree relative to `bvh` as a scene becomes more uneven.
Finding check_uniform(const Effort& effort) {
  const std::vector<double> skews{1.0, 1.5, 2.0, 3.0, 4.0};
  const std::vector<std::string> specs{"bvh", "octree", "octree:split=octree-r,planes=events", "kdtree"};
  const auto count = effort.choose<std::size_t>(20'000, 200'000);
  ReportTable table = trial_table();
  std::vector<PlotSeries> tests;
  std::vector<PlotSeries> speeds;
  std::array<double, 2> first{};
  std::array<double, 2> last{};
  for (const double skew : skews) {
    const TrialScene scene = scattered_scene({ScatteredPrimitive::triangles, count, skew}, effort.ray_count());
    const std::vector<StructureTrial> trials = try_structures(scene.scene, specs, scene.rays, effort.trials());
    add_trials(table, fmt::format("skew {}", skew), trials);
    for (const StructureTrial& trial : trials) {
      const double ratio = trial.tests / trials[0].tests;
      add_point(tests, trial.structure, {skew, ratio, ratio, ratio});
      add_point(speeds, trial.structure, spread_point(skew, speed_ratio(trial, trials[0])));
    }
    last = {speed_ratio(trials[1], trials[0]).median, trials[1].tests / trials[0].tests};
    if (skew == skews.front()) first = last;
  }
  const TrialScene hall = named_scene(fmt::format("builtin:stadium?triangles={}", count), RayKind::diffuse, effort.ray_count());
  const std::vector<StructureTrial> trials = try_structures(hall.scene, specs, hall.rays, effort.trials());
  add_trials(table, "stadium", trials);
  const double hall_speed = speed_ratio(trials[1], trials[0]).median;
  Finding finding;
  const bool worse_when_skewed = last[0] < 0.9 * first[0];
  const bool worse_in_hall = hall_speed < 0.9 * first[0];
  finding.verdict = worse_when_skewed && worse_in_hall   ? Verdict::holds
                    : worse_when_skewed || worse_in_hall ? Verdict::mixed
                                                         : Verdict::fails;
  finding.measured = fmt::format(
      "Against bvh the octree has {} of the speed and {} of the tests on evenly scattered triangles, {} and {} at skew 4, {} and {} for a "
      "dense "
      "object in a large hall.",
      short_number(first[0]), short_number(first[1]), short_number(last[0]), short_number(last[1]), short_number(hall_speed),
      short_number(trials[1].tests / trials[0].tests));
  finding.sections.push_back({"Speed against bvh as scenes become uneven",
                              "Coordinates are u^skew with u uniform; speeds are against bvh on the same rays.", table,
                              ReportPlot{PlotKind::line, {"skew"}, {"speed against bvh"}, speeds}});
  finding.sections.push_back({"Tests against bvh", "", {}, ReportPlot{PlotKind::line, {"skew"}, {"tests against bvh", true}, tests}});
  return finding;
}

Finding check_quick_build(const Effort& effort) {
  const std::vector<std::string> specs{"octree", "bvh", "bvh:split=lbvh", "kdtree"};
  ReportTable table{
      {"scene", "octree ms", "times bvh", "times lbvh", "times kdtree", "references a primitive", "ns a reference", "ns a primitive, bvh"},
      {}};
  std::vector<PlotSeries> series;
  TrialSettings settings = effort.trials();
  settings.build_rounds = effort.choose(3U, 5U);
  settings.rounds = 1;
  std::array<std::size_t, 3> quicker{};
  std::vector<std::string> names;
  std::vector<double> references;
  std::vector<double> each;
  std::vector<double> each_of_bvh;
  const std::vector<TrialScene> scenes = varied_scenes(effort.choose<std::size_t>(30'000, 200'000), RayKind::random, 1000);
  for (const TrialScene& scene : scenes) {
    const std::vector<StructureTrial> trials = try_structures(scene.scene, specs, scene.rays, settings);
    std::vector<ReportCell> row{scene.name, spread_text(spread_of(trials[0].build_seconds), 1e3)};
    for (std::size_t rival = 1; rival < trials.size(); ++rival) {
      const Spread ratio = build_ratio(trials[0], trials[rival]);
      row.emplace_back(spread_text(ratio));
      quicker[rival - 1] += ratio.median < 1.0 ? 1 : 0;
      add_point(series, trials[rival].structure, spread_point(static_cast<double>(names.size()), ratio));
    }
    const auto held = static_cast<double>(trials[0].statistics.references);
    references.push_back(held / scene.primitives());
    each.push_back(1e9 * spread_of(trials[0].build_seconds).median / held);
    each_of_bvh.push_back(1e9 * spread_of(trials[1].build_seconds).median / scene.primitives());
    row.insert(row.end(), {references.back(), each.back(), each_of_bvh.back()});
    table.rows.push_back(std::move(row));
    names.push_back(scene.name);
  }
  Finding finding;
  finding.verdict = quicker[0] == scenes.size() ? Verdict::holds : quicker[0] + quicker[2] == 0 ? Verdict::fails : Verdict::mixed;
  finding.measured =
      fmt::format("The octree is built sooner than bvh in {} of {} scenes, sooner than lbvh in {}, sooner than kdtree in {}.", quicker[0],
                  scenes.size(), quicker[1], quicker[2]);
  finding.why = fmt::format(
      "It knows its planes before it starts, but not which cells a primitive truly overlaps: it ends with {} references a primitive, {} ns "
      "each, where bvh "
      "takes {} ns for each primitive (geometric means).",
      short_number(geometric_mean(references)), short_number(geometric_mean(each)), short_number(geometric_mean(each_of_bvh)));
  finding.sections.push_back({"Build time of the octree against others", "All threads.", table,
                              ReportPlot{PlotKind::bar, {"", false, names}, {"octree's build time against", true}, series}});
  return finding;
}

Finding check_memory(const Effort& effort) {
  const std::vector<std::string> specs{"octree", "octree:store=inner", "bvh", "kdtree", "fast"};
  ReportTable table{{"scene", "structure", "MiB", "bytes a primitive", "nodes", "references a primitive", "MiB with eight pointers a node"},
                    {}};
  std::vector<PlotSeries> series;
  std::vector<std::string> names;
  std::size_t larger = 0;
  std::vector<double> pointers;
  TrialSettings settings = effort.trials();
  settings.rounds = 1;
  for (const TrialScene& scene : varied_scenes(effort.choose<std::size_t>(30'000, 300'000), RayKind::random, 100)) {
    const std::vector<StructureTrial> trials = try_structures(scene.scene, specs, scene.rays, settings);
    for (const StructureTrial& trial : trials) {
      const StructureStatistics& statistics = trial.statistics;
      const double each = static_cast<double>(statistics.bytes) / scene.primitives();
      const double mib = static_cast<double>(statistics.bytes) * 0x1p-20;
      ReportCell with_pointers = "";
      if (trial.structure.starts_with("octree")) {
        // A node as the review describes it has eight pointers of 8 bytes, one to its parent and a box of 24 bytes; this one's has 24 bytes in all.
        const double interior = static_cast<double>(statistics.nodes - statistics.leaves);
        constexpr double kMore = 8 * 8 + 8 + 24 - 24;
        with_pointers = mib + interior * kMore * 0x1p-20;
        if (trial.structure == "octree") pointers.push_back((mib + interior * kMore * 0x1p-20) / mib);
      }
      table.rows.push_back({scene.name, trial.structure, mib, each, static_cast<double>(statistics.nodes),
                            static_cast<double>(statistics.references) / scene.primitives(), with_pointers});
      add_point(series, trial.structure, {static_cast<double>(names.size()), each, each, each});
    }
    larger += trials[0].statistics.bytes > trials[2].statistics.bytes && trials[0].statistics.bytes > trials[3].statistics.bytes ? 1 : 0;
    names.push_back(scene.name);
  }
  Finding finding;
  finding.verdict = verdict_by_cases(larger, names.size());
  finding.measured = fmt::format(
      "In {} of {} scenes the octree takes more memory than both bvh and kdtree. It is the references that take it: nodes with eight "
      "pointers, a parent and a box would make it {} times as large.",
      larger, names.size(), short_number(geometric_mean(pointers)));
  finding.sections.push_back(
      {"Bytes a primitive", "", table, ReportPlot{PlotKind::bar, {"", false, names}, {"bytes a primitive"}, series}});
  return finding;
}

constexpr std::array kClaims{
    Claim{"octree-discards-geometry",
          "An octree quickly discards large portions of the geometry: tests are far fewer than against all geometry in the scene.",
          "III.A.2",
          "Evenly scattered spheres, rays from anywhere; tests a ray over the number of spheres. Holds when tests grow no faster than "
          "n^0.4 and "
          "are below 1 % of n at the end.",
          check_discards},
    Claim{"octree-uniform-scenes",
          "Octrees suit scenes of relatively uniform distribution and are less efficient where geometry is uneven.", "III.A.3",
          "Triangles scattered more and more unevenly, and a dense object in a large hall; the octree's speed against bvh. Holds when both "
          "cost the "
          "octree more than a tenth of what it has on even scenes.",
          check_uniform},
    Claim{"octree-builds-quickly",
          "Octrees need no knowledge of how objects are distributed, so they are constructed quickly and efficiently.", "III.A.3",
          "Build time against bvh (binned), lbvh and kdtree on five kinds of scenes. Holds when it is below that of bvh on all, fails when "
          "it is "
          "above those of bvh and kdtree on all.",
          check_quick_build},
    Claim{"octree-memory-overhead", "Octrees have a higher memory overhead: eight child pointers a node, and bounds or parent pointers.",
          "III.A.3", "Bytes of built structures on five kinds of scenes. Holds when the octree takes more than bvh and kdtree on all.",
          check_memory}};

}  // namespace

std::span<const Claim> octree_claims() {
  return kClaims;
}

}  // namespace grove
