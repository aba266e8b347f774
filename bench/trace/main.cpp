// Grove beside Embree on the same triangles and rays, in one process: whether the hits agree, then build and trace rates of interleaved
// rounds, each as a ratio to Embree in the same round.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <thread>

#include "grove/base/error.h"
#include "grove/base/output_file.h"
#include "grove/base/timer.h"
#include "grove/lab/machine.h"
#include "grove/lab/pinned.h"
#include "grove/lab/spread.h"
#include "grove/lab/workload.h"
#include "grove/scene/load.h"
#include "program.h"
#include "trace/agreement.h"
#include "trace/contender.h"
#include "trace/world_mesh.h"

namespace grove::bench {
namespace {

struct Options {
  std::vector<std::string> scenes;
  std::string structure = "bvh";
  bool in_batches = false;
  std::string embree_quality = "medium";
  bool embree_is_robust = true;
  std::string embree_isa;
  std::size_t agreement_rays = 1'000'000;
  std::size_t timed_rays = 300'000;
  int rounds = 5;
  bool only_agreement = false;
  std::string json;
};

std::string text(const Spread& spread) {
  return fmt::format("{:.3f} ({:.3f}-{:.3f})", spread.median, spread.min, spread.max);
}

nlohmann::json json(const Spread& spread) {
  return {{"median", spread.median}, {"min", spread.min}, {"max", spread.max}};
}

double trace_seconds(const Contender& contender, RayKind kind, std::span<const Ray> rays, std::span<Hit> hits) {
  const Timer timer;
  if (query_of(kind) == Query::closest) {
    contender.intersect(rays, hits);
  } else {
    std::vector<std::uint8_t> results(rays.size());
    contender.occluded(rays, results);
    // Keeps the work from being optimised away.
    hits[0].primitive = results[rays.size() / 2];
  }
  return timer.seconds();
}

nlohmann::json run_scene(const std::string& source, const Options& options, bool& all_explained) {
  const Scene loaded = load_scene(source);
  const auto mesh = world_mesh(loaded);
  const Scene scene = scene_of(loaded, mesh);
  const auto grove = make_grove(mesh, options.structure, options.in_batches ? Calls::all_rays : Calls::one_ray);
  const EmbreeQuality quality = options.embree_quality == "high" ? EmbreeQuality::high : EmbreeQuality::medium;
  const auto embree = make_embree(mesh, {quality, options.embree_is_robust, options.embree_isa});
  const int all_threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  fmt::print("\n{}: {} triangles; {}{} beside {}\n", source, mesh->size(), grove->name(), options.in_batches ? " in one batch" : "",
             embree->name());
  nlohmann::json row{{"scene", source}, {"triangles", mesh->size()}};

  const SceneAccelerator accelerator(scene, options.structure);
  const Camera camera = workload_camera(scene, "");
  const std::vector<Ray> random = make_rays(RayKind::random, scene, accelerator, camera, {options.agreement_rays, 1});
  std::vector<Hit> hits(random.size());
  std::vector<Hit> rival_hits(random.size());
  grove->build(all_threads);
  embree->build(1);
  grove->intersect(random, hits);
  embree->intersect(random, rival_hits);
  const Agreement agreement = compare_hits(*mesh, random, hits, rival_hits);
  const double agreeing = 100.0 * static_cast<double>(agreement.agreeing) / static_cast<double>(agreement.rays);
  fmt::print(
      "  agreement on {} random rays, {} hits: {:.5f} %; differing: {} at grazing edges, {} where Embree's t is less exact, {} "
      "unexplained\n",
      agreement.rays, agreement.hits, agreeing, agreement.grazing, agreement.imprecise, agreement.unexplained);
  for (const std::string& example : agreement.examples) fmt::print("    {}\n", example);
  all_explained = all_explained && agreement.unexplained == 0;
  row["agreement"] = {{"rays", agreement.rays},
                      {"agreeing", agreement.agreeing},
                      {"grazing", agreement.grazing},
                      {"imprecise", agreement.imprecise},
                      {"unexplained", agreement.unexplained}};
  if (options.only_agreement) return row;

  std::vector<double> grove_one, grove_all, embree_one, rate_ratio, speed_up;
  for (int round = 0; round < options.rounds; ++round) {
    {
      const Pinned pinned;
      embree_one.push_back(embree->build(1));
      // Embree's device caps the threads of oneTBB; it is let go of by building it again after this round's other builds.
      grove_one.push_back(grove->build(1));
    }
    rate_ratio.push_back(embree_one.back() / grove_one.back());
  }
  embree->build(all_threads);
  for (int round = 0; round < options.rounds; ++round) {
    double one = 0.0;
    {
      const Pinned pinned;
      one = grove->build(1);
    }
    grove_all.push_back(grove->build(all_threads));
    speed_up.push_back(one / grove_all.back());
  }
  fmt::print("  build, seconds: Grove {}, Embree {} on one thread; rate ratio {}\n", text(spread_of(grove_one)),
             text(spread_of(embree_one)), text(spread_of(rate_ratio)));
  fmt::print("  build on {} threads: {}; times one thread {}\n", all_threads, text(spread_of(grove_all)), text(spread_of(speed_up)));
  row["build"] = {{"grove_seconds", json(spread_of(grove_one))},
                  {"embree_seconds", json(spread_of(embree_one))},
                  {"rate_ratio", json(spread_of(rate_ratio))},
                  {"threads", all_threads},
                  {"grove_seconds_all_threads", json(spread_of(grove_all))},
                  {"speed_up", json(spread_of(speed_up))}};

  const Pinned pinned;
  for (const RayKind kind : ray_kinds()) {
    const std::vector<Ray> rays = make_rays(kind, scene, accelerator, camera, {options.timed_rays, 2});
    std::vector<Hit> scratch(rays.size());
    std::vector<double> grove_rate, embree_rate, ratio;
    for (int round = 0; round < options.rounds; ++round) {
      const double embree_seconds = trace_seconds(*embree, kind, rays, scratch);
      const double grove_seconds = trace_seconds(*grove, kind, rays, scratch);
      const double million = static_cast<double>(rays.size()) * 1e-6;
      grove_rate.push_back(million / grove_seconds);
      embree_rate.push_back(million / embree_seconds);
      ratio.push_back(embree_seconds / grove_seconds);
    }
    fmt::print("  {:8} Mrays/s, one thread: Grove {}, Embree {}; ratio {}\n", name_of(kind), text(spread_of(grove_rate)),
               text(spread_of(embree_rate)), text(spread_of(ratio)));
    row["trace"][std::string(name_of(kind))] = {{"grove_mrays_per_s", json(spread_of(grove_rate))},
                                                {"embree_mrays_per_s", json(spread_of(embree_rate))},
                                                {"ratio", json(spread_of(ratio))}};
  }
  return row;
}

int run(int argc, char** argv) {
  Options options;
  CLI::App app{"Grove beside Embree on the same triangles and rays."};
  app.add_option("scenes", options.scenes, "files or built-in scenes; by default three built-in ones of a million triangles");
  app.add_option("--structure", options.structure, "what to set against Embree");
  app.add_flag("--batch", options.in_batches, "give the structure all rays in one call; the rival gets one ray a call");
  app.add_option("--embree-quality", options.embree_quality, "medium or high")->check(CLI::IsMember({"medium", "high"}));
  app.add_flag("--embree-robust,!--no-embree-robust", options.embree_is_robust, "with Embree's flag for watertight tests (default)");
  app.add_option("--embree-isa", options.embree_isa, "the instruction set for Embree, such as avx2 (default: its own choice)");
  app.add_option("--agreement-rays", options.agreement_rays, "random rays whose hits are compared")->check(CLI::Range(1, 100'000'000));
  app.add_option("--rays", options.timed_rays, "rays a round")->check(CLI::Range(1, 100'000'000));
  app.add_option("--rounds", options.rounds, "rounds")->check(CLI::Range(1, 1000));
  app.add_flag("--only-agreement", options.only_agreement, "compare hits and time nothing");
  app.add_option("--json", options.json, "write the figures here");
  CLI11_PARSE(app, argc, argv);
  if (options.scenes.empty())
    options.scenes = {"builtin:mount?triangles=1000000", "builtin:sphereflake?shape=triangles&triangles=1000000",
                      "builtin:tree?triangles=1000000"};

  const Machine machine = describe_machine();
  fmt::print("{}, {} cores, {}, {}\n", machine.cpu, machine.cores, machine.compiler, machine.os);
  nlohmann::json report{{"machine", {{"cpu", machine.cpu}, {"cores", machine.cores}, {"compiler", machine.compiler}, {"os", machine.os}}}};
  bool all_explained = true;
  for (const std::string& scene : options.scenes) report["scenes"].push_back(run_scene(scene, options, all_explained));
  if (!options.json.empty()) write_text_file(options.json, report.dump(2) + "\n");
  return all_explained ? 0 : 1;
}

}  // namespace
}  // namespace grove::bench

int main(int argc, char** argv) {
  return grove::bench::run_program("grove_trace_bench", grove::bench::run, argc, argv);
}
