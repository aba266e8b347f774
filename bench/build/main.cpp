// How long builders take beside Embree's three qualities, by default those of the family `bvh`, on one pinned thread and on all, and a refit beside a
// rebuild. In one process, round by round; the figures are ratios within a round.

#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <thread>

#include "grove/base/output_file.h"
#include "grove/base/timer.h"
#include "grove/lab/machine.h"
#include "grove/lab/pinned.h"
#include "grove/lab/spread.h"
#include "grove/registry/registry.h"
#include "grove/scene/load.h"
#include "program.h"
#include "trace/contender.h"
#include "trace/world_mesh.h"

namespace grove::bench {
namespace {

struct Options {
  std::vector<std::string> scenes;
  std::vector<std::string> structures;
  int rounds = 5;
  std::string json;
};

nlohmann::json json(const Spread& spread) {
  return {{"median", spread.median}, {"min", spread.min}, {"max", spread.max}};
}

// Seconds of each contender, round by round, on one thread and on all.
struct Measured {
  std::string name;
  double cost = 0.0;  // 0 for the rival, whose cost is not known
  std::vector<double> one;
  std::vector<double> all;
};

// base[i] / seconds[i]: how many times as fast as the base in the same round.
Spread speed_against(const std::vector<double>& base, const std::vector<double>& seconds) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < seconds.size(); ++i) ratios.push_back(base[i] / seconds[i]);
  return spread_of(ratios);
}

std::string text(const Spread& spread) {
  return fmt::format("{:.2f} ({:.2f}-{:.2f})", spread.median, spread.min, spread.max);
}

// Updates of the same mesh where it stands: every pass has all of its work to do.
std::vector<Measured> measure_updates(const std::shared_ptr<const TriangleMesh>& mesh, int threads, int rounds) {
  const auto structure = build(GeometryPointer(mesh), "bvh");
  std::vector<Measured> rows;
  for (const UpdatePolicy policy : {UpdatePolicy::rebuild, UpdatePolicy::refit, UpdatePolicy::rotate, UpdatePolicy::automatic})
    rows.push_back({"update " + std::string(name_of(policy)), 0.0, {}, {}});
  // What an update learns of a new structure is learnt once.
  static_cast<void>(structure->update({UpdatePolicy::refit, 1e6}));
  for (int round = 0; round < rounds; ++round) {
    for (const int count : {1, threads}) {
      oneapi::tbb::task_arena arena(count);
      arena.execute([&] {
        const std::unique_ptr<Pinned> pinned = count == 1 ? std::make_unique<Pinned>() : nullptr;
        for (std::size_t i = 1; i <= rows.size(); ++i) {
          // The rebuild comes last, and a refit that is not counted after it.
          Measured& row = rows[i % rows.size()];
          const UpdatePolicy policy = parse_update_policy(std::string_view(row.name).substr(7));
          const UpdateReport report = structure->update({policy, 1e6});
          (count == 1 ? row.one : row.all).push_back(report.seconds);
          row.cost = report.cost;
        }
        static_cast<void>(structure->update({UpdatePolicy::refit, 1e6}));
      });
    }
  }
  return rows;
}

nlohmann::json run_scene(const std::string& source, const Options& options) {
  const auto mesh = world_mesh(load_scene(source));
  const int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  std::vector<std::unique_ptr<Contender>> contenders;
  for (const std::string& spec : options.structures) contenders.push_back(make_grove(mesh, spec));
  const std::size_t own = contenders.size();
  for (const EmbreeQuality quality : {EmbreeQuality::low, EmbreeQuality::medium, EmbreeQuality::high})
    contenders.push_back(make_embree(mesh, {.quality = quality, .robust = quality != EmbreeQuality::high, .isa = {}}));
  std::vector<Measured> rows;
  rows.reserve(contenders.size());
  for (const auto& contender : contenders) rows.push_back({contender->name(), 0.0, {}, {}});
  for (int round = 0; round < options.rounds; ++round) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto release = [&] { contenders[i]->release(); };
      {
        const Pinned pinned;
        rows[i].one.push_back(contenders[i]->build(1));
        release();
      }
      rows[i].all.push_back(contenders[i]->build(threads));
      release();
    }
  }
  for (std::size_t i = 0; i < own; ++i) rows[i].cost = build(GeometryPointer(mesh), rows[i].name)->statistics().expected_cost;

  const Measured& medium = rows[own + 1];
  // The rival of the quality that a structure names.
  const auto rival_of = [&](const Measured& row) -> const Measured& {
    const auto names = [&](const char* text) { return row.name.find(text) != std::string::npos; };
    return rows[own + (names("low") ? 0 : names("high") ? 2 : 1)];
  };
  fmt::print("\n{}: {} triangles; seconds and millions of triangles a second on one thread, and on {}\n", source, mesh->size(), threads);
  fmt::print("{:34} {:>8} {:>7} {:>19} {:>19} {:>19} {:>19} {:>18} {:>18} {:>18} {:>9}\n", "builder", "s", "M/s", "/ Embree medium, 1",
             fmt::format("/ Embree medium, {}", threads), "/ Embree alike, 1", fmt::format("/ Embree alike, {}", threads), "/ first, 1",
             fmt::format("/ first, {}", threads), fmt::format("{} threads / 1", threads), "cost");
  nlohmann::json result{{"scene", source}, {"triangles", mesh->size()}, {"threads", threads}};
  const auto print = [&](const Measured& row, const Measured& first) {
    const Spread one = spread_of(row.one);
    fmt::print("{:34} {:8.4f} {:7.2f} {:>19} {:>19} {:>19} {:>19} {:>18} {:>18} {:>18} {:>9}\n", row.name, one.median,
               static_cast<double>(mesh->size()) * 1e-6 / one.median, text(speed_against(medium.one, row.one)),
               text(speed_against(medium.all, row.all)), text(speed_against(rival_of(row).one, row.one)),
               text(speed_against(rival_of(row).all, row.all)), text(speed_against(first.one, row.one)),
               text(speed_against(first.all, row.all)), text(speed_against(row.one, row.all)),
               row.cost > 0.0 ? fmt::format("{:.2f}", row.cost) : "-");
    result["rows"].push_back({{"builder", row.name},
                              {"cost", row.cost},
                              {"seconds_one_thread", json(one)},
                              {"seconds_all_threads", json(spread_of(row.all))},
                              {"speed_up", json(speed_against(row.one, row.all))},
                              {"against_embree_medium", json(speed_against(medium.one, row.one))},
                              {"against_embree_medium_all_threads", json(speed_against(medium.all, row.all))},
                              {"against_embree_alike", json(speed_against(rival_of(row).one, row.one))},
                              {"against_embree_alike_all_threads", json(speed_against(rival_of(row).all, row.all))},
                              {"against_first", json(speed_against(first.one, row.one))},
                              {"against_first_all_threads", json(speed_against(first.all, row.all))}});
  };
  for (const Measured& row : rows) print(row, rows.front());
  const std::vector<Measured> updates = measure_updates(mesh, threads, options.rounds);
  for (const Measured& row : updates) print(row, updates.front());
  return result;
}

int run(int argc, char** argv) {
  Options options;
  CLI::App app{"Builders beside Embree's, and refits beside rebuilds."};
  app.add_option("scenes", options.scenes, "files or built-in scenes; by default three built-in ones of a million triangles");
  app.add_option("--structure", options.structures, "specs to build; the first is the one to compare with");
  app.add_option("--rounds", options.rounds, "rounds")->check(CLI::Range(1, 1000));
  app.add_option("--json", options.json, "write the figures here");
  CLI11_PARSE(app, argc, argv);
  if (options.scenes.empty())
    options.scenes = {"builtin:mount?triangles=1000000", "builtin:sphereflake?shape=triangles&triangles=1000000",
                      "builtin:tree?triangles=1000000"};
  if (options.structures.empty())
    options.structures = {"bvh", "bvh:split=ploc", "bvh:split=lbvh", "bvh:split=sweep", "bvh:split=spatial", "bvh:optimize=reinsertion"};
  const Machine machine = describe_machine();
  fmt::print("{}, {} cores, {}, {}\n", machine.cpu, machine.cores, machine.compiler, machine.os);
  nlohmann::json report{{"machine", {{"cpu", machine.cpu}, {"cores", machine.cores}, {"compiler", machine.compiler}, {"os", machine.os}}}};
  for (const std::string& scene : options.scenes) report["scenes"].push_back(run_scene(scene, options));
  if (!options.json.empty()) write_text_file(options.json, report.dump(2) + "\n");
  return 0;
}

}  // namespace
}  // namespace grove::bench

int main(int argc, char** argv) {
  return grove::bench::run_program("grove_build_bench", grove::bench::run, argc, argv);
}
