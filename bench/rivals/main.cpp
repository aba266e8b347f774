// Grove beside Embree in one process: builds, memory, and closest and any hits, in every way that either can be asked, on the same triangles and rays,
// interleaved round by round.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <thread>

#include "grove/base/error.h"
#include "grove/base/output_file.h"
#include "grove/lab/machine.h"
#include "grove/registry/registry.h"
#include "program.h"
#include "rivals/report.h"

namespace grove::bench::rivals {
namespace {

struct Options {
  std::vector<std::string> scenes;
  std::vector<std::string> kinds;
  std::string structures = "fast;fast:triangles=fast";
  MeasureSettings settings;
  bool is_quick = false;
  bool is_one_thread = false;
  std::string json;
};

std::vector<std::string> default_scenes() {
  std::vector<std::string> scenes = {"builtin:mount?triangles=1000000", "builtin:sphereflake?shape=triangles&triangles=1000000",
                                     "builtin:tree?triangles=1000000"};
  for (const char* const name :
       {"classroom/scene-v4.pbrt", "country-kitchen/scene-v4.pbrt", "coffee-maker/scene-v4.pbrt", "flight-helmet/FlightHelmet.gltf",
        "pine-tree/forest.gltf", "stanford-scans/bun_zipper.ply", "hair-tuft/scene-v4.pbrt"}) {
    const std::filesystem::path file = std::filesystem::path(GROVE_SOURCE_DIR).parent_path() / "shared" / "scenes" / name;
    std::error_code error;
    if (std::filesystem::exists(file, error)) scenes.push_back(file.string());
  }
  return scenes;
}

void check(Options& options, const CLI::App& app) {
  if (options.is_quick) {
    if (options.scenes.empty()) options.scenes = {"builtin:mount?triangles=20000", "builtin:tree?triangles=20000"};
    if (app.count("--rays") == 0) options.settings.rays = 20'000;
    if (app.count("--rounds") == 0) options.settings.rounds = 2;
    if (app.count("--build-rounds") == 0) options.settings.build_rounds = 1;
  }
  options.settings.structures.clear();
  for (const std::string& spec : CLI::detail::split(options.structures, ';')) options.settings.structures.push_back(canonical_spec(spec));
  if (options.scenes.empty()) options.scenes = default_scenes();
  for (const std::string& kind : options.kinds) options.settings.kinds.push_back(parse_ray_kind(kind));
  if (options.kinds.empty()) options.settings.kinds.assign(ray_kinds().begin(), ray_kinds().end());
  options.settings.threads = options.is_one_thread ? 1 : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  if (!options.json.empty()) check_writable(options.json);
}

int run(int argc, char** argv) {
  Options options;
  MeasureSettings& settings = options.settings;
  CLI::App app{"Grove beside Embree: build time, memory, and rays a second in every way that either can be asked."};
  app.add_option(
      "scenes", options.scenes,
      "files or built-in scenes; by default three built-in ones of a million triangles and those of ../shared/scenes that are there");
  app.add_option("--structures", options.structures,
                 "Grove's structures that are asked in every way, between ';'; the first is what hits must agree with")
      ->capture_default_str();
  app.add_option("--kinds", options.kinds, "kinds of rays: primary, diffuse, shadow, random (default: all)")
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_option("--rays", settings.rays, "rays of each kind")->check(CLI::Range(1, 100'000'000))->capture_default_str();
  app.add_option("--samples", settings.samples_per_pixel, "primary rays of a pixel, one after another: with several they are coherent")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
  app.add_option("--rounds", settings.rounds, "rounds of tracing")->check(CLI::Range(1, 1000))->capture_default_str();
  app.add_option("--build-rounds", settings.build_rounds, "rounds of building")->check(CLI::Range(1, 1000))->capture_default_str();
  app.add_flag("--one-thread", options.is_one_thread, "measure on one pinned thread only, not on all as well");
  app.add_flag("--quick", options.is_quick, "few rays, rounds and triangles: to see that it works");
  app.add_option("--json", options.json, "write all figures here");
  CLI11_PARSE(app, argc, argv);
  check(options, app);

  const Machine machine = describe_machine();
  fmt::print("{}, {} cores, {}, {}; {} rays of each kind, {} rounds\n", machine.cpu, machine.cores, machine.compiler, machine.os,
             settings.rays, settings.rounds);
  nlohmann::ordered_json report{{"format", "grove-rivals"}, {"version", 1}};
  report["machine"] = {
      {"cpu", machine.cpu}, {"cores", machine.cores}, {"compiler", machine.compiler}, {"commit", machine.commit}, {"os", machine.os}};
  report["rays"] = settings.rays;
  report["samples_per_pixel"] = settings.samples_per_pixel;
  report["rounds"] = settings.rounds;
  report["build_rounds"] = settings.build_rounds;
  report["threads"] = settings.threads;
  std::vector<SceneResult> results;
  bool all_agree = true;
  for (const std::string& scene : options.scenes) {
    results.push_back(measure_scene(scene, settings));
    const SceneResult& result = results.back();
    all_agree = all_agree && std::ranges::all_of(result.agreements, &WayAgreement::is_good);
    fmt::print("{}", text_of(result));
    std::fflush(stdout);
    report["scenes"].push_back(json_of(result));
    // After each scene, so that an interrupted run leaves what it has.
    if (!options.json.empty()) write_text_file(options.json, report.dump(1) + "\n");
  }
  fmt::print("{}", summary_of(results));
  if (!all_agree) fmt::print(stderr, "grove_rival_bench: some hits did not agree; the tables above say which\n");
  return all_agree ? 0 : 1;
}

}  // namespace
}  // namespace grove::bench::rivals

int main(int argc, char** argv) {
  return grove::bench::run_program("grove_rival_bench", grove::bench::rivals::run, argc, argv);
}
