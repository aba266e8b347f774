// What the review says of heuristics for splitting (sections III.C.1, III.C.2 and IV.B): their order, what the surface-area heuristic does, and where its planes lie.

#include <fmt/format.h>

#include <array>

#include "grove/lab/claims/claim.h"
#include "grove/lab/claims/figures.h"
#include "grove/lab/largest_object.h"
#include "grove/lab/plane_study.h"
#include "grove/lab/regression.h"
#include "grove/lab/text_table.h"

namespace grove {
namespace {

Finding check_order(const Effort& effort) {
  const std::vector<std::string> specs{"bvh:split=spatial-median", "bvh:split=object-median", "bvh", "bvh:split=sweep"};
  SceneContest contest{2};
  std::array<std::vector<double>, 4> costs;
  std::size_t heuristic_best = 0;
  std::size_t spatial_last = 0;
  for (const TrialScene& scene : varied_scenes(effort.choose<std::size_t>(20'000, 200'000), RayKind::diffuse, effort.ray_count())) {
    const std::vector<StructureTrial> trials = try_structures(scene.scene, specs, scene.rays, effort.trials());
    contest.add(scene.name, trials);
    for (std::size_t i = 0; i < 4; ++i) costs.at(i).push_back(trials[i].statistics.expected_cost / trials[2].statistics.expected_cost);
    const double spatial = contest.speed[0].back();
    const double object = contest.speed[1].back();
    heuristic_best += spatial < 1.0 && object < 1.0 ? 1 : 0;
    spatial_last += spatial < object && object < 1.0 ? 1 : 0;
  }
  const std::size_t scenes = contest.scenes.size();
  Finding finding;
  finding.verdict = verdict_by_cases(spatial_last, scenes);
  finding.measured = fmt::format(
      "The surface-area heuristic is fastest in {} of {} scenes; against it (binned) the spatial median has {} of the speed, the object "
      "median {} and the exact sweep {} "
      "(geometric means). Spatial median, object median, surface-area heuristic from slow to fast: in {} of {}.",
      heuristic_best, scenes, short_number(geometric_mean(contest.speed[0])), short_number(geometric_mean(contest.speed[1])),
      short_number(geometric_mean(contest.speed[3])), spatial_last, scenes);
  finding.why = fmt::format(
      "Rays make {} times the steps of bvh with spatial medians, {} with object medians; the expected cost is {} and {} times that of bvh. "
      "A spatial median "
      "halves the box, whose children are small wherever objects are; an object median puts half of the objects on each side however far "
      "they "
      "reach.",
      short_number(geometric_mean(contest.steps[0])), short_number(geometric_mean(contest.steps[1])),
      short_number(geometric_mean(costs[0])), short_number(geometric_mean(costs[1])));
  if (finding.verdict == Verdict::fails && heuristic_best > 0) finding.verdict = Verdict::mixed;
  finding.sections.push_back({"Speed against the binned surface-area heuristic", "", contest.table,
                              ReportPlot{PlotKind::bar, {"", false, contest.scenes}, {"speed against bvh"}, contest.speeds}});
  return finding;
}

Finding check_build_time(const Effort& effort) {
  const std::vector<std::string> specs{"bvh", "bvh:split=sweep", "bvh:split=object-median", "bvh:split=spatial-median", "kdtree"};
  TrialSettings settings = effort.trials();
  settings.build_rounds = effort.choose(3U, 5U);
  settings.rounds = 1;
  ReportTable table{{"scene", "bvh ms", "sweep", "object median", "spatial median", "kdtree"}, {}};
  std::vector<PlotSeries> series;
  std::vector<std::string> names;
  std::array<std::vector<double>, 5> ratios;
  for (const TrialScene& scene : varied_scenes(effort.choose<std::size_t>(30'000, 200'000), RayKind::random, 100)) {
    const std::vector<StructureTrial> trials = try_structures(scene.scene, specs, scene.rays, settings);
    std::vector<ReportCell> row{scene.name, 1e3 * spread_of(trials[0].build_seconds).median};
    for (std::size_t i = 1; i < trials.size(); ++i) {
      const Spread ratio = build_ratio(trials[i], trials[0]);
      ratios[i].push_back(ratio.median);
      row.emplace_back(spread_text(ratio));
      add_point(series, trials[i].structure, spread_point(static_cast<double>(names.size()), ratio));
    }
    table.rows.push_back(std::move(row));
    names.push_back(scene.name);
  }
  const double sweep = geometric_mean(ratios[1]);
  const double medians = std::max(geometric_mean(ratios[2]), geometric_mean(ratios[3]));
  Finding finding;
  finding.verdict = medians > 1.0 ? Verdict::holds : sweep > 1.0 ? Verdict::mixed : Verdict::fails;
  finding.measured = fmt::format(
      "Against binning with the surface-area heuristic, building takes {} times as long by the exact sweep, {} by object medians, {} by "
      "spatial medians and {} for a kd-tree (geometric means).",
      short_number(sweep), short_number(geometric_mean(ratios[2])), short_number(geometric_mean(ratios[3])),
      short_number(geometric_mean(ratios[4])));
  finding.sections.push_back({"Build time against bvh", "All threads.", table,
                              ReportPlot{PlotKind::bar, {"", false, names}, {"build time against bvh", true}, series}});
  return finding;
}

double share(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

struct StudiedScene {
  std::string name;
  PlaneStudy objects;
  PlaneStudy space;
};

std::vector<StudiedScene> study_scenes(const Effort& effort, bool with_space) {
  std::vector<StudiedScene> studies;
  for (const TrialScene& scene : varied_scenes(effort.choose<std::size_t>(10'000, 100'000), RayKind::random, 1)) {
    effort.check_stop();
    const ReferenceList list = std::visit([](const auto& set) { return list_references(*set); }, largest_object(scene.scene)->geometry);
    StudiedScene& study = studies.emplace_back(StudiedScene{scene.name, study_planes(list, PartedBy::objects, 24), {}});
    if (with_space) study.space = study_planes(list, PartedBy::space, effort.choose(12U, 16U));
  }
  return studies;
}

Finding check_between_medians(const Effort& effort) {
  ReportTable table{{"scene", "parted", "nodes", "between the medians", "on each axis", "cost between / best", "eight candidates",
                     "spatial median", "object median"},
                    {}};
  std::vector<PlotSeries> series;
  PlaneTally objects;
  PlaneTally space;
  const auto add = [&](const std::string& scene, const char* what, const PlaneTally& tally) {
    const auto nodes = static_cast<double>(tally.nodes);
    table.rows.push_back({scene, what, nodes, share(tally.between, tally.nodes), share(tally.between_on_axis, tally.axes),
                          tally.cost_between / nodes, tally.cost_candidates / nodes, tally.cost_spatial / nodes,
                          tally.cost_object / nodes});
  };
  for (const StudiedScene& study : study_scenes(effort, true)) {
    add(study.name, "objects", study.objects.all);
    add(study.name, "space", study.space.all);
    objects.add(study.objects.all);
    space.add(study.space.all);
    for (std::size_t level = 0; level < study.space.levels.size(); ++level) {
      const PlaneTally& tally = study.space.levels[level];
      if (tally.nodes == 0) continue;
      const double between = share(tally.between, tally.nodes);
      add_point(series, study.name, {static_cast<double>(level), between, between, between});
    }
  }
  const double of_objects = share(objects.between, objects.nodes);
  const double of_space = share(space.between, space.nodes);
  Finding finding;
  finding.verdict = std::min(of_objects, of_space) > 0.95  ? Verdict::holds
                    : std::max(of_objects, of_space) < 0.5 ? Verdict::fails
                                                           : Verdict::mixed;
  finding.measured = fmt::format(
      "The cheapest plane lies between the medians in {:.0f} % of {} nodes where objects are parted, and in {:.0f} % of {} where space is. "
      "Looking only there costs {} and {} on "
      "average, with eight candidates {} and {}.",
      100.0 * of_objects, with_separators(objects.nodes), 100.0 * of_space, with_separators(space.nodes),
      percent_more(objects.cost_between / static_cast<double>(objects.nodes)),
      percent_more(space.cost_between / static_cast<double>(space.nodes)),
      percent_more(objects.cost_candidates / static_cast<double>(objects.nodes)),
      percent_more(space.cost_candidates / static_cast<double>(space.nodes)));
  finding.sections.push_back({"How often the cheapest plane lies between the medians",
                              "All planes of all three axes are tried at each node; costs are sums of tests by the chance of meeting each "
                              "side, relative to the cheapest of all.",
                              table, ReportPlot{PlotKind::line, {"level"}, {"share of cells whose cheapest plane is between"}, series}});
  return finding;
}

Finding check_crowd(const Effort& effort) {
  ReportTable table{{"scene", "nodes", "uneven", "more objects in the smaller area", "more objects for its area"}, {}};
  std::vector<PlotSeries> series;
  PlaneTally all;
  for (const StudiedScene& study : study_scenes(effort, false)) {
    const PlaneTally& tally = study.objects.all;
    table.rows.push_back({study.name, static_cast<double>(tally.nodes), static_cast<double>(tally.uneven),
                          share(tally.crowd_is_smaller, tally.uneven), share(tally.crowd_is_denser, tally.uneven)});
    all.add(tally);
    for (std::size_t level = 0; level < study.objects.levels.size(); ++level) {
      const PlaneTally& at = study.objects.levels[level];
      const double smaller = share(at.crowd_is_smaller, at.uneven);
      if (at.uneven > 0) add_point(series, study.name, {static_cast<double>(level), smaller, smaller, smaller});
    }
  }
  const double smaller = share(all.crowd_is_smaller, all.uneven);
  Finding finding;
  finding.verdict = smaller > 0.9 ? Verdict::holds : smaller < 0.5 ? Verdict::fails : Verdict::mixed;
  finding.measured = fmt::format("Of {} cheapest splits that leave more on one side, {:.0f} % leave the crowd in the smaller area.",
                                 with_separators(all.uneven), 100.0 * smaller);
  finding.why = fmt::format(
      "The heuristic lowers the sum of area times objects, which parts off what is dense: the crowd has more objects for its area in "
      "{:.0f} % "
      "of these splits. Where density is even, more objects just take more area.",
      100.0 * share(all.crowd_is_denser, all.uneven));
  finding.sections.push_back({"How often the side with more objects has the smaller area", "", table,
                              ReportPlot{PlotKind::line, {"level"}, {"share of uneven splits"}, series}});
  return finding;
}

constexpr std::array kClaims{
    Claim{"split-heuristics",
          "Spatial median, object median and surface-area heuristic are ways to part a hierarchy, each better than the one before.",
          "III.C.1",
          "Speed of hierarchies by each on five kinds of scenes. Holds when the order is this in all; the surface-area heuristic alone "
          "being fastest is mixed.",
          check_order},
    Claim{"sah-crowd", "The surface-area heuristic parts so that the area with the most objects gets the least volume.", "III.C.2",
          "At every node of hierarchies parted at the cheapest plane: whether the side with more objects has the smaller area. Holds above "
          "90 % of the splits that are "
          "uneven, fails below half.",
          check_crowd},
    Claim{"sah-builds-faster", "With the surface-area heuristic the construction of hierarchies can be relatively faster.", "III.C.3",
          "Build time by binning with the heuristic against its exact sweep, both medians and a kd-tree. Holds when binning is faster than "
          "the medians, fails when even the sweep is "
          "faster.",
          check_build_time},
    Claim{"best-plane-between-medians",
          "The best splitting plane lies between the spatial median and the object median (MacDonald and Booth 1990).", "IV.B",
          "The cheapest of all planes at each node, for hierarchies (objects are parted) and for cells (space is, by equation 9). Holds "
          "above 95 % of the nodes for both, fails "
          "below half for both.",
          check_between_medians}};

}  // namespace

std::span<const Claim> heuristic_claims() {
  return kClaims;
}

}  // namespace grove
