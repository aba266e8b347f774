#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "grove/base/error.h"
#include "grove/base/output_file.h"
#include "grove/base/timer.h"
#include "grove/lab/batch.h"
#include "grove/lab/comparison_report.h"
#include "grove/lab/ray_file.h"
#include "grove/lab/structure_report.h"
#include "grove/lab/text_table.h"
#include "progress_bar.h"
#include "session.h"
#include "verbs.h"

namespace grove::app {
namespace {

constexpr std::uint64_t kMostRepeats = 1'000'000;
/// Rays between two looks at the clock and the signals.
constexpr std::size_t kSliceSize = std::size_t{1} << 21;

struct TraceOptions : CommonOptions {
  std::string rays;
  std::string hits;
  std::string query = "closest";
  unsigned repeat = 1;
};

Query parse_query(const std::string& name) {
  for (const Query query : {Query::closest, Query::any}) {
    if (name == name_of(query)) return query;
  }
  throw UsageError("--query: '" + name + "' is not a query; the queries are closest and any");
}

/// Traces all rays `repeat` times; the rate of each time in millions of rays a second.
std::vector<double> trace_repeatedly(const Accelerator& accelerator, Query query, std::span<const Ray> rays, std::span<Hit> hits,
                                     unsigned repeat, const ProgressReporter& progress) {
  std::vector<double> rates;
  for (unsigned round = 0; round < repeat; ++round) {
    double seconds = 0.0;
    for (std::size_t first = 0; first < rays.size(); first += kSliceSize) {
      const std::size_t count = std::min(kSliceSize, rays.size() - first);
      const Timer timer;
      trace(accelerator, query, rays.subspan(first, count), hits.subspan(first, count));
      seconds += timer.seconds();
      progress.report(round * rays.size() + first + count, repeat * rays.size());
    }
    rates.push_back(rays.empty() ? 0.0 : 1e-6 * static_cast<double>(rays.size()) / seconds);
  }
  return rates;
}

/// The structure over the scene, which is given up but for its geometry.
BuiltStructure build_lean(const TraceOptions& options, const std::string& spec, const Console& console) {
  Scene scene = load(options.scene, console);
  drop_shading_data(scene);
  return build_structure(scene, spec, console);
}

int run(const TraceOptions& options, Interrupts& interrupts) {
  const Console console(options.quiet);
  const std::string spec = canonical_spec(options.structure);
  const Query query = parse_query(options.query);
  check_writable(options.hits);
  if (!options.json.empty()) check_writable(options.json);
  // Opened and checked before the long work, read after it, so that the rays are not in memory while the structure is built.
  RayFile file(options.rays);
  const BuiltStructure built = build_lean(options, spec, console);
  console.status("reading " + options.rays);
  const std::vector<Ray> rays = file.read();
  std::vector<Hit> hits(rays.size());
  console.clear_status();

  std::vector<double> rates;
  {
    ProgressBar bar("tracing", "rays", 1.0, options.quiet);
    rates = trace_repeatedly(built.accelerator.top(), query, rays, hits, options.repeat, bar.reporter(interrupts.token()));
  }
  const Spread rate = spread_of(rates);
  const auto hit_count = std::count_if(hits.begin(), hits.end(), [&](const Hit& hit) { return std::isfinite(hit.t); });
  console.say(fmt::format(
      "rays       {} {} in the file, {} {}: {} Mrays/s{}", with_separators(rays.size()), rays.size() == 1 ? "ray" : "rays",
      with_separators(static_cast<std::uint64_t>(hit_count)), query == Query::any ? "occluded" : "hit something", short_number(rate.median),
      options.repeat == 1 ? "" : fmt::format(" (median of {}: {} to {})", options.repeat, short_number(rate.min), short_number(rate.max))));

  // What is being written is finished first; a second signal ends it.
  const Interrupts::Graceful graceful(interrupts);
  write_hits(options.hits, hits);
  if (!options.json.empty()) {
    nlohmann::ordered_json json = structure_json(spec, built.statistics, arena_threads());
    json["scene"] = options.scene;
    json["rays"] = rays.size();
    json["query"] = name_of(query);
    json["repeat"] = options.repeat;
    json["mrays_per_s"] = spread_json(rate);
    write_text_file(options.json, json.dump(2) + "\n");
  }
  console.say("wrote      " + options.hits);
  return 0;
}

}  // namespace

Verb add_trace(CLI::App& program) {
  const auto options = std::make_shared<TraceOptions>();
  CLI::App& verb = *program.add_subcommand("trace", "Answer ray queries from a NumPy file");
  add_scene(verb, *options);
  verb.add_option("--rays", options->rays, "Rays to trace: float32, shape (N, 8): origin x y z, t_min, direction x y z, t_max")
      ->required()
      ->type_name("R.npy");
  verb.add_option("--hits", options->hits, "Where hits go: records of t, u, v, primitive, geometry, instance")
      ->required()
      ->type_name("H.npy");
  add_structure(verb, *options);
  verb.add_option("--query", options->query, "closest, or any (t is 0 where occluded, inf where not)")
      ->type_name("QUERY")
      ->capture_default_str();
  add_threads(verb, *options);
  in_range(verb.add_option("--repeat", options->repeat, "Trace all rays this often, for the rate")->type_name("K")->capture_default_str(),
           std::uint64_t{1}, kMostRepeats);
  add_json(verb, *options, "structure and rates");
  add_quiet(verb, *options);
  verb.footer(
      "Examples, after python3 -c \"import numpy as n; r = n.random.rand(1000, 8).astype('f4'); r[:, 3] = 0; r[:, 7] = n.inf; "
      "n.save('rays.npy', r)\":\n"
      "  grove trace builtin:sphereflake --rays rays.npy --hits hits.npy\n"
      "  grove trace builtin:sphereflake --rays rays.npy --hits hits.npy --query any --repeat 5 --json trace.json");
  return {&verb, [options](Interrupts& interrupts) { return with_threads(options->threads, [&] { return run(*options, interrupts); }); }};
}

}  // namespace grove::app
