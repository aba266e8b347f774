// The experiments on octrees whose tables docs/octree.md has: octree-R beside an octree of as many leaves on ever more uneven scenes, how many planes it is
// worth to try, both walks and both stores, updates, and how well equation 5 of the review predicts times. On one pinned thread, round by round.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "grove/base/output_file.h"
#include "grove/lab/machine.h"
#include "grove/lab/octree_trial.h"
#include "grove/lab/pinned.h"
#include "grove/lab/scattered_geometry.h"
#include "grove/lab/spread.h"
#include "program.h"

namespace grove::bench {
namespace {

struct Options {
  std::string experiment = "gain";
  std::vector<std::string> primitives{"spheres", "triangles"};
  std::vector<std::size_t> counts{10000, 100000};
  std::vector<double> skews{1.0, 1.5, 2.0, 3.0, 4.0};
  std::vector<std::string> searches{"candidates", "events", "joint"};
  std::size_t rays = 20000;
  unsigned rounds = 5;
  int builds = 8;
  std::string walk = "top-down";
  std::string json;
};

OctreeRSearch search_of(const std::string& name) {
  if (name == "events") return OctreeRSearch::events;
  return name == "joint" ? OctreeRSearch::joint : OctreeRSearch::candidates;
}

OctreeSettings octree_r(const std::string& search) {
  return {.split = OctreeSplit::octree_r, .search = search_of(search)};
}

// By how many percent more rays a second go through the other, round by round.
Spread gain_in_time(const OctreeTrial& base, const OctreeTrial& other) {
  std::vector<double> gains;
  for (std::size_t i = 0; i < base.nanoseconds.size(); ++i) gains.push_back(100.0 * (base.nanoseconds[i] / other.nanoseconds[i] - 1.0));
  return spread_of(gains);
}

nlohmann::json json_of(const Spread& spread) {
  return {{"median", spread.median}, {"min", spread.min}, {"max", spread.max}};
}

nlohmann::json json_of(const OctreeTrial& trial) {
  return {{"name", trial.name},
          {"nodes", trial.nodes},
          {"leaves", trial.leaves},
          {"references", trial.references},
          {"bytes", trial.bytes},
          {"build_seconds", trial.build_seconds},
          {"nodes_visited", trial.nodes_visited},
          {"leaves_entered", trial.leaves_entered},
          {"tests", trial.tests},
          {"nanoseconds", json_of(spread_of(trial.nanoseconds))}};
}

// One scene of an experiment.
struct Scene {
  ScatterSettings settings;
  GeometryPointer geometry;
  std::vector<Ray> rays;

  Scene(ScatteredPrimitive primitive, std::size_t count, double skew, std::size_t ray_count)
      : settings{primitive, count, skew, 1}, geometry(scatter(settings)), rays(rays_inside({Vec3(0.0F), Vec3(1.0F)}, ray_count, 2)) {}

  [[nodiscard]] nlohmann::json json() const {
    return {{"primitives", name_of(settings.primitive)}, {"count", settings.count}, {"skew", settings.skew}};
  }
};

template <typename Body>
void for_each_scene(const Options& options, const Body& body) {
  for (const std::string& name : options.primitives) {
    const auto primitive = name == "triangles" ? ScatteredPrimitive::triangles : ScatteredPrimitive::spheres;
    for (const std::size_t count : options.counts)
      for (const double skew : options.skews) body(Scene(primitive, count, skew, options.rays));
  }
}

void print_trials(const Scene& scene, std::span<const OctreeTrial> trials, nlohmann::json& rows) {
  for (const OctreeTrial& trial : trials) {
    const OctreeTrial& base = trials.front();
    const Spread gain = gain_in_time(base, trial);
    fmt::print("| {} | {} | {} | {} | {} | {:.3g} | {:.0f} | {:.3g} | {:.3g} | {:+.0f} % | {:.0f} | {:+.0f} % ({:+.0f} to {:+.0f}) |\n",
               name_of(scene.settings.primitive), scene.settings.count, scene.settings.skew, trial.name, trial.leaves,
               static_cast<double>(trial.bytes) * 0x1p-20, 1e3 * trial.build_seconds, trial.nodes_visited, trial.tests,
               100.0 * (base.tests / trial.tests - 1.0), spread_of(trial.nanoseconds).median, gain.median, gain.min, gain.max);
    std::fflush(stdout);
    nlohmann::json row = scene.json();
    row.update(json_of(trial));
    row["gain_in_tests"] = 100.0 * (base.tests / trial.tests - 1.0);
    row["gain_in_time"] = json_of(gain);
    rows.push_back(std::move(row));
  }
}

void print_head() {
  fmt::print(
      "| primitives | count | skew | octree | leaves | MiB | build ms | nodes a ray | tests | gain in tests | ns a ray | gain in time |\n");
  fmt::print("| --- | ---: | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | --- |\n");
}

// Octree-R with as many leaves as the octree has by default.
nlohmann::json run_gain(const Options& options) {
  nlohmann::json rows = nlohmann::json::array();
  print_head();
  for_each_scene(options, [&](const Scene& scene) {
    std::vector<OctreeContender> contenders{{"octree", {}}};
    const std::uint64_t leaves = count_octree_leaves(scene.geometry, {});
    for (const std::string& search : options.searches)
      contenders.push_back({search, match_leaves(scene.geometry, octree_r(search), leaves, options.builds)});
    const Pinned pinned;
    print_trials(scene, try_octrees(scene.geometry, contenders, scene.rays, options.rounds), rows);
  });
  return rows;
}

// Octree-R as it stops by itself, with more and more candidates.
nlohmann::json run_candidates(const Options& options) {
  nlohmann::json rows = nlohmann::json::array();
  print_head();
  for_each_scene(options, [&](const Scene& scene) {
    std::vector<OctreeContender> contenders{{"octree", {}}};
    for (const std::uint32_t count : {1U, 2U, 4U, 8U, 16U, 32U, 64U}) {
      OctreeSettings settings = octree_r("candidates");
      settings.candidate_count = count;
      contenders.push_back({fmt::format("{} candidates", count), settings});
    }
    const Pinned pinned;
    print_trials(scene, try_octrees(scene.geometry, contenders, scene.rays, options.rounds), rows);
  });
  return rows;
}

// Both walks and both stores, with and without a mailbox.
nlohmann::json run_walks(const Options& options) {
  nlohmann::json rows = nlohmann::json::array();
  print_head();
  for_each_scene(options, [&](const Scene& scene) {
    const OctreeSettings inner{.store = OctreeStore::inner};
    const OctreeContender contenders[] = {{"octree", {}},
                                          {"without mailbox", {}, OctreeWalk::top_down, UseMailbox::no},
                                          {"neighbour", {}, OctreeWalk::neighbour},
                                          {"neighbour by links", {}, OctreeWalk::neighbour, UseMailbox::yes, true},
                                          {"inner", inner, OctreeWalk::top_down, UseMailbox::no},
                                          {"inner, neighbour", inner, OctreeWalk::neighbour, UseMailbox::no},
                                          {"octree-R", octree_r("candidates")},
                                          {"octree-R, neighbour", octree_r("candidates"), OctreeWalk::neighbour},
                                          {"octree-R by links", octree_r("candidates"), OctreeWalk::neighbour, UseMailbox::yes, true}};
    const Pinned pinned;
    print_trials(scene, try_octrees(scene.geometry, contenders, scene.rays, options.rounds), rows);
  });
  return rows;
}

// Trees that follow primitives which are put elsewhere, against building anew, on all threads.
nlohmann::json run_update(const Options& options) {
  nlohmann::json rows = nlohmann::json::array();
  fmt::print(
      "| primitives | count | skew | octree | moved | update ms | build ms | times as fast |\n| --- | ---: | ---: | --- | ---: | ---: | "
      "---: | --- |\n");
  for_each_scene(options, [&](const Scene& scene) {
    const std::pair<const char*, OctreeSettings> trees[] = {
        {"leaf", {}}, {"inner", {.store = OctreeStore::inner}}, {"octree-R", octree_r("candidates")}};
    for (const auto& [name, settings] : trees) {
      for (const std::size_t stride : {10000U, 1000U, 100U, 10U, 4U}) {
        std::vector<std::uint32_t> moved;
        const GeometryPointer after = scatter_again(scene.settings, stride, 7, moved);
        const OctreeUpdateTrial trial = try_octree_update(scene.geometry, after, moved, settings, options.rounds);
        std::vector<double> ratios;
        for (std::size_t i = 0; i < trial.update_seconds.size(); ++i) ratios.push_back(trial.build_seconds[i] / trial.update_seconds[i]);
        const Spread ratio = spread_of(ratios);
        fmt::print("| {} | {} | {} | {} | {} | {:.3g} | {:.3g} | {:.1f} ({:.1f} to {:.1f}) |\n", name_of(scene.settings.primitive),
                   scene.settings.count, scene.settings.skew, name, moved.size(), 1e3 * spread_of(trial.update_seconds).median,
                   1e3 * spread_of(trial.build_seconds).median, ratio.median, ratio.min, ratio.max);
        nlohmann::json row = scene.json();
        row.update({{"name", name},
                    {"moved", moved.size()},
                    {"update_seconds", json_of(spread_of(trial.update_seconds))},
                    {"build_seconds", json_of(spread_of(trial.build_seconds))},
                    {"times_as_fast", json_of(ratio)}});
        rows.push_back(std::move(row));
      }
    }
  });
  return rows;
}

// Trees of many sizes: their times against those of the equation fitted to them.
nlohmann::json run_cost(const Options& options) {
  nlohmann::json rows = nlohmann::json::array();
  for_each_scene(options, [&](const Scene& scene) {
    std::vector<OctreeContender> contenders;
    const OctreeWalk walk = options.walk == "neighbour" ? OctreeWalk::neighbour : OctreeWalk::top_down;
    for (const std::uint32_t leaf_size : {1U, 2U, 4U, 8U, 16U, 32U, 64U}) {
      contenders.push_back({fmt::format("octree, leaves of {}", leaf_size), {.leaf_size = leaf_size}, walk});
      OctreeSettings settings = octree_r("events");
      settings.leaf_size = leaf_size;
      contenders.push_back({fmt::format("octree-R, leaves of {}", leaf_size), settings, walk});
    }
    const Pinned pinned;
    const std::vector<OctreeTrial> trials = try_octrees(scene.geometry, contenders, scene.rays, options.rounds);
    const Equation5 fit = fit_equation_5(trials);
    fmt::print("\n{} {} at skew {}: {:.0f} ns a ray + {:.1f} ns a node + {:.1f} ns a test; R² {:.3f}; a test costs {:.2f} of a node\n",
               scene.settings.count, name_of(scene.settings.primitive), scene.settings.skew, fit.per_ray, fit.per_voxel, fit.per_test,
               fit.r_squared, fit.per_test / fit.per_voxel);
    fmt::print("| octree | nodes a ray | tests | ns measured | ns predicted | error |\n| --- | ---: | ---: | ---: | ---: | ---: |\n");
    nlohmann::json result = scene.json();
    result.update({{"per_ray", fit.per_ray}, {"per_voxel", fit.per_voxel}, {"per_test", fit.per_test}, {"r_squared", fit.r_squared}});
    for (const OctreeTrial& trial : trials) {
      const double measured = spread_of(trial.nanoseconds).median;
      fmt::print("| {} | {:.3g} | {:.3g} | {:.0f} | {:.0f} | {:+.0f} % |\n", trial.name, trial.nodes_visited, trial.tests, measured,
                 fit.predict(trial), 100.0 * (fit.predict(trial) / measured - 1.0));
      result["trials"].push_back(json_of(trial));
      result["trials"].back()["predicted"] = fit.predict(trial);
    }
    rows.push_back(std::move(result));
  });
  return rows;
}

int run(int argc, char** argv) {
  Options options;
  CLI::App app{"Experiments on octrees: octree-R against octree, candidates, and the cost model."};
  app.add_option("experiment", options.experiment, "gain, candidates, walks, update or cost")
      ->check(CLI::IsMember({"gain", "candidates", "walks", "update", "cost"}));
  app.add_option("--primitives", options.primitives, "spheres, triangles")->check(CLI::IsMember({"spheres", "triangles"}));
  app.add_option("--counts", options.counts, "how many primitives");
  app.add_option("--skews", options.skews, "how uneven: coordinates are u^skew")->check(CLI::Range(0.1, 100.0));
  app.add_option("--searches", options.searches, "gain: how octree-R chooses planes")
      ->check(CLI::IsMember({"candidates", "events", "joint"}));
  app.add_option("--walk", options.walk, "cost: how rays walk")->check(CLI::IsMember({"top-down", "neighbour"}));
  app.add_option("--rays", options.rays, "rays a round")->check(CLI::Range(1, 100000000));
  app.add_option("--rounds", options.rounds, "rounds")->check(CLI::Range(1, 1000));
  app.add_option("--builds", options.builds, "gain: trees that are built to match the number of leaves")->check(CLI::Range(1, 100));
  app.add_option("--json", options.json, "write the figures here");
  CLI11_PARSE(app, argc, argv);
  const Machine machine = describe_machine();
  fmt::print("{}, {}, {}\n\n", machine.cpu, machine.compiler, machine.os);
  nlohmann::json report{{"experiment", options.experiment},
                        {"machine", {{"cpu", machine.cpu}, {"cores", machine.cores}, {"compiler", machine.compiler}, {"os", machine.os}}}};
  report["rows"] = options.experiment == "gain"         ? run_gain(options)
                   : options.experiment == "candidates" ? run_candidates(options)
                   : options.experiment == "walks"      ? run_walks(options)
                   : options.experiment == "update"     ? run_update(options)
                                                        : run_cost(options);
  if (!options.json.empty()) write_text_file(options.json, report.dump(2) + "\n");
  return 0;
}

}  // namespace
}  // namespace grove::bench

int main(int argc, char** argv) {
  return grove::bench::run_program("grove_octree_bench", grove::bench::run, argc, argv);
}
