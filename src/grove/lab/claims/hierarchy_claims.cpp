// What the review says of bounding volume hierarchies (section III.C): which volumes to prefer, and that rays traverse them in parallel.

#include <fmt/format.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/task_arena.h>

#include <array>

#include "grove/base/timer.h"
#include "grove/lab/claims/claim.h"
#include "grove/lab/claims/figures.h"
#include "grove/lab/regression.h"
#include "grove/lab/text_table.h"
#include "grove/render/scene_accelerator.h"

namespace grove {
namespace {

Finding check_volumes(const Effort& effort) {
  const std::vector<std::string> specs{"bvh", "bvh:bounds=obb", "bvh:bounds=sphere"};
  SceneContest contest;
  std::vector<PlotSeries> steps;
  std::size_t in_order = 0;
  std::size_t boxes_first = 0;
  for (const TrialScene& scene : varied_scenes(effort.choose<std::size_t>(15'000, 100'000), RayKind::diffuse, effort.ray_count())) {
    const std::vector<StructureTrial> trials = try_structures(scene.scene, specs, scene.rays, effort.trials());
    contest.add(scene.name, trials);
    for (std::size_t i = 0; i < trials.size(); ++i) {
      const double work = contest.steps[i].back();
      add_point(steps, trials[i].structure, {static_cast<double>(contest.scenes.size() - 1), work, work, work});
    }
    const double oriented = contest.speed[1].back();
    const double spheres = contest.speed[2].back();
    in_order += oriented < 1.0 && spheres < oriented ? 1 : 0;
    boxes_first += oriented < 1.0 && spheres < 1.0 ? 1 : 0;
  }
  const std::size_t scenes = contest.scenes.size();
  Finding finding;
  finding.verdict = verdict_by_cases(boxes_first, scenes);
  finding.measured = fmt::format(
      "Boxes are fastest in {} of {} scenes; oriented boxes have {} of their speed at {} of their steps, spheres {} at {} (geometric "
      "means). Boxes, then oriented "
      "boxes, then spheres: in {} of {}.",
      boxes_first, scenes, short_number(geometric_mean(contest.speed[1])), short_number(geometric_mean(contest.steps[1])),
      short_number(geometric_mean(contest.speed[2])), short_number(geometric_mean(contest.steps[2])), in_order, scenes);
  finding.sections.push_back({"Speed against axis-aligned boxes", "The same topology for all three volumes.", contest.table,
                              ReportPlot{PlotKind::bar, {"", false, contest.scenes}, {"speed against boxes"}, contest.speeds}});
  finding.sections.push_back({"Nodes and tests against axis-aligned boxes",
                              "",
                              {},
                              ReportPlot{PlotKind::bar, {"", false, contest.scenes}, {"nodes + tests against boxes"}, steps}});
  return finding;
}

/// Millions of rays a second by so many threads.
double rate_by(unsigned threads, const Accelerator& accelerator, std::span<const Ray> rays, std::span<Hit> hits) {
  constexpr double kShortest = 0.1;
  oneapi::tbb::task_arena arena(static_cast<int>(threads));
  return arena.execute([&] {
    const Timer timer;
    std::size_t repeats = 0;
    do {
      trace(accelerator, Query::closest, rays, hits);
      ++repeats;
    } while (timer.seconds() < kShortest);
    return 1e-6 * static_cast<double>(repeats * rays.size()) / timer.seconds();
  });
}

Finding check_parallel_traversal(const Effort& effort) {
  const auto most = static_cast<unsigned>(oneapi::tbb::info::default_concurrency());
  ReportTable table{{"structure", "threads", "Mrays/s", "against one thread"}, {}};
  std::vector<PlotSeries> series;
  const TrialScene scene = named_scene(fmt::format("builtin:tree?triangles={}", effort.choose(50'000, 500'000)), RayKind::diffuse, 100'000);
  std::vector<Hit> hits(scene.rays.size());
  std::vector<double> efficiency;
  for (const char* const spec : {"bvh", "bvh:arity=8", "fast", "kdtree", "octree"}) {
    const SceneAccelerator accelerator(scene.scene, spec);
    std::vector<std::vector<double>> rates(most + 1);
    for (unsigned round = 0; round < effort.rounds(); ++round) {
      for (unsigned threads = 1; threads <= most; ++threads) {
        effort.check_stop();
        rates[threads].push_back(rate_by(threads, accelerator.top(), scene.rays, hits));
      }
    }
    for (unsigned threads = 1; threads <= most; ++threads) {
      const Spread against_one = spread_of(ratios_by_round(rates[threads], rates[1]));
      table.rows.push_back(
          {accelerator.spec(), static_cast<double>(threads), spread_text(spread_of(rates[threads])), spread_text(against_one)});
      add_point(series, accelerator.spec(), spread_point(threads, against_one));
      if (threads == most) efficiency.push_back(against_one.median / most);
    }
  }
  Finding finding;
  finding.verdict = most < 2               ? Verdict::mixed
                    : efficiency[0] > 0.8  ? Verdict::holds
                    : efficiency[0] < 0.55 ? Verdict::fails
                                           : Verdict::mixed;
  finding.measured = fmt::format(
      "{} threads trace {} times as many rays through bvh as one ({} with fast, {} with octree): an efficiency of {:.0f} %.", most,
      short_number(efficiency[0] * most), short_number(efficiency[2] * most), short_number(efficiency[4] * most), 100.0 * efficiency[0]);
  finding.sections.push_back({"Rays a second by threads", "Diffuse rays in a tree of leaves.", table,
                              ReportPlot{PlotKind::line, {"threads"}, {"rays a second against one thread"}, series}});
  return finding;
}

constexpr std::array kClaims{Claim{"volumes",
                                   "Axis-aligned boxes are generally preferred to oriented boxes for their lower cost of intersection; "
                                   "spheres are used in rare cases.",
                                   "III.C.1",
                                   "The same hierarchies with three kinds of volumes on five kinds of scenes. Holds when boxes are fastest "
                                   "in all, fails when they are in none.",
                                   check_volumes},
                             Claim{"parallel-traversal", "Hierarchies can be traversed in parallel.", "III.C.3",
                                   "Rays a second by number of threads. Holds when all threads together reach 80 % of their number times "
                                   "one thread's rate, fails below 55 %.",
                                   check_parallel_traversal}};

}  // namespace

std::span<const Claim> hierarchy_claims() {
  return kClaims;
}

}  // namespace grove
