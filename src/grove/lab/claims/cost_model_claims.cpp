// The review's cost models against what rays do and how long it takes: equations 2, 3, 5 and 8.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "grove/build/octree/octree_r_cost.h"
#include "grove/build/top_down.h"
#include "grove/lab/chance_study.h"
#include "grove/lab/claims/claim.h"
#include "grove/lab/claims/figures.h"
#include "grove/lab/largest_object.h"
#include "grove/lab/octree_trial.h"
#include "grove/lab/regression.h"
#include "grove/lab/text_table.h"

namespace grove {
namespace {

ReferenceList references_of(const Scene& scene) {
  return std::visit([](const auto& set) { return list_references(*set); }, largest_object(scene)->geometry);
}

Finding check_area_ratio(const Effort& effort) {
  const auto lines = effort.choose<std::size_t>(200'000, 2'000'000);
  ReportTable table{
      {"scene", "rays", "pairs", "mean of measured / area ratio", "typical departure (r.m.s.)", "of which chance alone", "R²"}, {}};
  std::vector<PlotSeries> series;
  double uniform_departure = 0.0;
  double uniform_noise = 0.0;
  double renderer_departure = 0.0;
  for (const TrialScene& scene : varied_scenes(effort.choose<std::size_t>(10'000, 100'000), RayKind::diffuse, lines / 4)) {
    effort.check_stop();
    const Bvh2 tree = build_top_down(references_of(scene.scene), {});
    const SceneAccelerator accelerator(scene.scene, kDefaultSpec);
    const Camera camera = workload_camera(scene.scene, "");
    const auto kind = [&](RayKind one) { return make_rays(one, scene.scene, accelerator, camera, {lines / 4, 1}); };
    const std::array sources{std::pair{"uniform lines", lines_through(tree.bounds, lines, 3)},
                             std::pair{"random origins", kind(RayKind::random)}, std::pair{"primary", kind(RayKind::primary)},
                             std::pair{"diffuse", scene.rays}};
    for (const auto& [name, rays] : sources) {
      const bool are_lines = std::string_view(name) == "uniform lines";
      const ChanceStudy study = study_chances(tree, rays, are_lines ? nullptr : &accelerator.top());
      table.rows.push_back({scene.name, std::string(name), static_cast<double>(study.pairs.size()), study.mean_ratio, study.departure,
                            study.noise, study.r_squared});
      if (are_lines && study.departure >= uniform_departure) {
        uniform_departure = study.departure;
        uniform_noise = study.noise;
      }
      if (!are_lines) renderer_departure = std::max(renderer_departure, study.departure);
      if (scene.name != "mount") continue;
      for (std::size_t i = 0; i < study.pairs.size(); i += std::max<std::size_t>(1, study.pairs.size() / 150))
        add_point(series, name, {study.pairs[i].expected, study.pairs[i].measured, study.pairs[i].measured, study.pairs[i].measured});
    }
  }
  Finding finding;
  const bool lines_agree = uniform_departure < 2.0 * uniform_noise + 0.01;
  finding.verdict = !lines_agree ? Verdict::fails : renderer_departure < 0.1 ? Verdict::holds : Verdict::mixed;
  finding.measured = fmt::format(
      "For uniform lines the share that meets a child's box departs from the ratio of areas by at most {} (r.m.s., relative; chance alone "
      "makes {}). For rays as a "
      "renderer shoots them, which start somewhere and end at what they hit, it departs by up to {}.",
      short_number(uniform_departure), short_number(uniform_noise), short_number(renderer_departure));
  finding.sections.push_back(
      {"Chance of meeting a child's box, measured against the ratio of areas",
       "Nodes of a hierarchy whose parents at least 500 rays meet. The plot shows some of those of the mountains. A ray "
       "meets a box when it passes through it before it ends.",
       table, ReportPlot{PlotKind::scatter, {"ratio of areas"}, {"share of the parent's rays"}, series}});
  return finding;
}

/// What a fit needs of one structure on one scene.
struct Observation {
  std::string scene;
  std::string family;
  std::string structure;
  double cost = 0.0;
  double nodes = 0.0;
  double tests = 0.0;
  double nanoseconds = 0.0;
};

std::vector<Observation> observe(const Effort& effort, std::span<const std::string> specs) {
  std::vector<Observation> observations;
  for (TrialScene& scene : varied_scenes(effort.choose<std::size_t>(15'000, 100'000), RayKind::random, effort.ray_count())) {
    // Lines as the cost model takes them to be.
    scene.rays = lines_through(scene.scene.bounds(), effort.ray_count(), 5);
    for (const StructureTrial& trial : try_structures(scene.scene, specs, scene.rays, effort.trials())) {
      observations.push_back({scene.name, trial.structure.substr(0, trial.structure.find(':')), trial.structure,
                              trial.statistics.expected_cost, trial.nodes, trial.tests, spread_of(trial.nanoseconds).median});
    }
  }
  return observations;
}

Finding check_expected_cost(const Effort& effort) {
  const std::vector<std::string> specs{"bvh",
                                       "bvh:split=sweep",
                                       "bvh:split=spatial",
                                       "bvh:split=object-median",
                                       "bvh:split=spatial-median",
                                       "bvh:split=lbvh",
                                       "bvh:split=ploc",
                                       "bvh:optimize=reinsertion",
                                       "bvh:leaf-size=1",
                                       "bvh:leaf-size=32",
                                       "bvh:cost=equation-2"};
  const std::vector<Observation> observations = observe(effort, specs);
  ReportTable table{{"scene", "structure", "expected cost", "nodes + 0.35 tests a ray", "ns a ray"}, {}};
  std::vector<PlotSeries> series;
  std::vector<double> causes;
  std::vector<double> times;
  std::vector<double> within;
  std::vector<double> counted;
  std::vector<std::string> by_scene;
  for (std::size_t first = 0; first < observations.size(); first += specs.size()) {
    std::vector<double> costs;
    std::vector<double> scene_times;
    std::vector<double> scene_work;
    for (std::size_t i = first; i < first + specs.size(); ++i) {
      const Observation& one = observations[i];
      scene_work.push_back(one.nodes + 0.35 * one.tests);
      table.rows.push_back({one.scene, one.structure, one.cost, scene_work.back(), one.nanoseconds});
      add_point(series, one.scene, {one.cost, one.nanoseconds, one.nanoseconds, one.nanoseconds});
      costs.push_back(one.cost);
      scene_times.push_back(one.nanoseconds);
      causes.insert(causes.end(), {1.0, one.cost});
      times.push_back(one.nanoseconds);
    }
    within.push_back(correlation(costs, scene_times));
    counted.push_back(correlation(costs, scene_work));
    by_scene.push_back(fmt::format("{} {:.2f}", observations[first].scene, within.back()));
  }
  const LinearFit fit = fit_linear(causes, 2, times, PriceSign::not_negative);
  const double least = *std::ranges::min_element(within);
  Finding finding;
  finding.verdict = least > 0.9 && fit.r_squared > 0.9   ? Verdict::holds
                    : least < 0.5 && fit.r_squared < 0.5 ? Verdict::fails
                                                         : Verdict::mixed;
  finding.measured = fmt::format(
      "Within a scene the expected cost of a hierarchy and the time of uniform lines correlate by {}; over all scenes one line ({} ns + {} "
      "ns a unit of cost) explains R² = {:.2f} of the times.",
      fmt::join(by_scene, ", "), short_number(fit.prices[0]), short_number(fit.prices[1]), fit.r_squared);
  finding.why = fmt::format(
      "What is counted, nodes and 0.35 times the tests, correlates with the expected cost by {:.2f} or more within each scene, so the "
      "model is right about "
      "steps; what time departs by is that steps do not all take the same, and what a ray takes besides steps.",
      *std::ranges::min_element(counted));
  finding.sections.push_back({"Time of a ray over expected cost",
                              "Equation 2 summed over the tree, a step as 1 and a test as 0.35; closest hits of uniform lines, one thread.",
                              table, ReportPlot{PlotKind::scatter, {"expected cost", true}, {"ns a ray", true}, series}});
  return finding;
}

Finding check_equation_5(const Effort& effort) {
  const std::vector<std::string> specs{"octree",
                                       "octree:leaf-size=2",
                                       "octree:leaf-size=32",
                                       "octree:walk=neighbour",
                                       "octree-r",
                                       "octree-r:planes=events",
                                       "octree-r:planes=events,leaf-size=16",
                                       "kdtree",
                                       "kdtree:split=binned",
                                       "kdtree:split=object-median",
                                       "kdtree:split=spatial-median",
                                       "kdtree:leaf-size=16",
                                       "bvh",
                                       "bvh:split=object-median",
                                       "bvh:split=lbvh",
                                       "bvh:leaf-size=1",
                                       "bvh:leaf-size=32"};
  const std::vector<Observation> observations = observe(effort, specs);
  ReportTable fits{{"fitted to", "observations", "ns a ray", "ns a node (T_v)", "ns a test (T_i)", "R²", "typical error"}, {}};
  ReportTable table{{"scene", "structure", "nodes a ray", "tests a ray", "ns measured", "ns predicted"}, {}};
  std::vector<PlotSeries> series;
  std::vector<double> qualities;
  double over_all = 0.0;
  for (const std::string family : {"octree", "kdtree", "bvh", ""}) {
    std::vector<double> causes;
    std::vector<double> times;
    for (const Observation& one : observations) {
      if (!family.empty() && one.family != family) continue;
      // Walks by neighbours have steps of another price.
      if (!family.empty() && one.structure.find("neighbour") != std::string::npos) continue;
      causes.insert(causes.end(), {1.0, one.nodes, one.tests});
      times.push_back(one.nanoseconds);
    }
    const LinearFit fit = fit_linear(causes, 3, times, PriceSign::not_negative);
    std::vector<double> errors;
    for (std::size_t i = 0; i < times.size(); ++i)
      errors.push_back(std::exp(std::fabs(std::log(std::max(1e-3, fit.predict(std::span(causes).subspan(3 * i, 3))) / times[i]))));
    fits.rows.push_back({family.empty() ? "all" : family, static_cast<double>(times.size()), fit.prices[0], fit.prices[1], fit.prices[2],
                         fit.r_squared, percent_more(geometric_mean(errors))});
    if (family.empty()) {
      over_all = fit.r_squared;
      continue;
    }
    qualities.push_back(fit.r_squared);
    for (const Observation& one : observations) {
      if (one.family != family || one.structure.find("neighbour") != std::string::npos) continue;
      const double predicted = fit.predict(std::array{1.0, one.nodes, one.tests});
      table.rows.push_back({one.scene, one.structure, one.nodes, one.tests, one.nanoseconds, predicted});
      add_point(series, family, {predicted, one.nanoseconds, one.nanoseconds, one.nanoseconds});
    }
  }
  const double least = *std::ranges::min_element(qualities);
  Finding finding;
  finding.verdict = least > 0.9 ? Verdict::holds : *std::ranges::max_element(qualities) < 0.5 ? Verdict::fails : Verdict::mixed;
  finding.measured = fmt::format(
      "Steps and tests at fitted prices explain R² = {:.3f} of the times of octrees, {:.3f} of kd-trees, {:.3f} of hierarchies, each "
      "family with prices of its own; with one set of prices for all, {:.3f}.",
      qualities[0], qualities[1], qualities[2], over_all);
  finding.sections.push_back(
      {"Prices by family",
       "Non-negative least squares over structures and scenes; a typical error is the geometric mean of how far predictions are off.",
       fits,
       {}});
  finding.sections.push_back({"Predicted against measured", "Uniform lines, closest hits, one thread.", table,
                              ReportPlot{PlotKind::scatter, {"ns a ray, predicted", true}, {"ns a ray, measured", true}, series}});
  return finding;
}

Finding check_expected_tests(const Effort& effort) {
  ReportTable table{{"scene", "axis", "rays", "planes", "R²", "mean of measured / expected", "worst"}, {}};
  std::vector<PlotSeries> series;
  double worst_lines = 1.0;
  double worst_rays = 1.0;
  const auto lines = effort.choose<std::size_t>(50'000, 400'000);
  for (const TrialScene& scene : varied_scenes(effort.choose<std::size_t>(10'000, 100'000), RayKind::diffuse, lines)) {
    effort.check_stop();
    const ReferenceList list = references_of(scene.scene);
    const SceneAccelerator accelerator(scene.scene, kDefaultSpec);
    const std::array sources{std::pair{"uniform lines", lines_through(list.bounds, lines, 11)}, std::pair{"diffuse", scene.rays}};
    for (const auto& [name, rays] : sources) {
      const bool are_lines = std::string_view(name) == "uniform lines";
      for (int axis = 0; axis < 3; ++axis) {
        const std::vector<PlaneTests> planes = study_expected_tests(list, axis, 31, rays, are_lines ? nullptr : &accelerator.top());
        std::vector<double> causes;
        std::vector<double> measured;
        double worst = 1.0;
        double sum = 0.0;
        for (const PlaneTests& plane : planes) {
          causes.push_back(plane.expected);
          measured.push_back(plane.measured);
          const double ratio = plane.measured / plane.expected;
          sum += ratio;
          if (std::fabs(std::log(ratio)) > std::fabs(std::log(worst))) worst = ratio;
          if (axis == 0)
            add_point(series, fmt::format("{}, {}", scene.name, name), {plane.expected, plane.measured, plane.measured, plane.measured});
        }
        const double linear = correlation(causes, measured);
        table.rows.push_back({scene.name, std::string(1, "xyz"[axis]), std::string(name), static_cast<double>(planes.size()),
                              linear * linear, sum / static_cast<double>(planes.size()), worst});
        double& worst_of_kind = are_lines ? worst_lines : worst_rays;
        if (std::fabs(std::log(worst)) > std::fabs(std::log(worst_of_kind))) worst_of_kind = worst;
      }
    }
  }
  const bool lines_hold = std::fabs(std::log(worst_lines)) < 0.05;
  const bool rays_hold = std::fabs(std::log(worst_rays)) < 0.1;
  Finding finding;
  finding.verdict = lines_hold && rays_hold ? Verdict::holds : lines_hold ? Verdict::mixed : Verdict::fails;
  finding.measured = fmt::format(
      "For uniform lines the tests counted are those expected by equation 8 to {} at worst; for diffuse rays, which end at what they hit, "
      "they are {} of them at the worst plane.",
      percent_more(worst_lines), short_number(worst_rays));
  finding.sections.push_back(
      {"Tests a ray through a divided space, counted against equation 8",
       "The box of the scene parted at 31 planes an axis; a ray tests all objects of each side that it passes through before it ends.",
       table, ReportPlot{PlotKind::scatter, {"expected tests", true}, {"counted tests", true}, series}});
  return finding;
}

constexpr std::array kClaims{
    Claim{"area-ratio", "A ray that meets a convex volume meets a convex volume inside it with the ratio of their areas as probability.",
          "III.C.2, equations 3, 4",
          "Monte Carlo over the nodes of hierarchies, for uniform lines and for rays of a renderer. Fails when uniform lines depart by "
          "more than twice what chance makes; holds when the "
          "renderer's depart by less than a tenth as well.",
          check_area_ratio},
    Claim{"sah-predicts-time", "The cost function of the surface-area heuristic is the expected time of a ray.", "III.C.2, equation 2",
          "Expected cost against measured time over eleven builders and five kinds of scenes. Holds when they correlate above 0.9 within "
          "every scene and one line explains "
          "R² > 0.9 over all; fails when neither reaches half.",
          check_expected_cost},
    Claim{"time-is-steps-and-tests", "The time of a ray is the voxels it passes times T_v and the tests it makes times T_i.",
          "IV.B, equation 5",
          "Prices fitted by regression over structures and scenes. Holds when they explain R² > 0.9 of the times within each family, fails "
          "when they do not explain half in "
          "any.",
          check_equation_5},
    Claim{"expected-tests",
          "The expected number of tests in a divided space follows from areas and the objects on each side and across the plane.",
          "IV.B, equations 6 to 9",
          "Tests counted with rays against equation 8. Holds when they agree within 5 % for uniform lines and 10 % for diffuse rays at "
          "every plane, fails when uniform lines do not.",
          check_expected_tests}};

}  // namespace

std::span<const Claim> cost_model_claims() {
  return kClaims;
}

}  // namespace grove
