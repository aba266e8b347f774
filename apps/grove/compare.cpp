#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>

#include "command_line.h"
#include "grove/base/error.h"
#include "grove/base/output_file.h"
#include "grove/lab/comparison.h"
#include "grove/lab/comparison_report.h"
#include "grove/lab/matched_memory.h"
#include "grove/lab/structure_trial.h"
#include "html_file.h"
#include "progress_bar.h"
#include "scale.h"
#include "session.h"
#include "trial_builder.h"
#include "verbs.h"

namespace grove::app {
namespace {

constexpr std::uint64_t kMostRounds = 10'000;
constexpr std::uint64_t kMostRays = 100'000'000;

struct CompareOptions : CommonOptions {
  std::string structures;
  std::string rays;
  std::filesystem::path csv;
  std::string memory_limit;
  BuildLimits limits;
  bool matches_memory = false;
  ScaleOptions scale;
  ComparisonSettings settings;
};

/// Turns the texts of options into settings.
void read_lists(CompareOptions& options) {
  if (!options.memory_limit.empty()) options.limits.bytes = parse_size("--memory-limit", options.memory_limit);
  options.limits.seconds = options.settings.time_limit;
  if (!options.structures.empty()) {
    for (const std::string& spec : split_list("--structures", options.structures, ';')) {
      options.settings.structures.push_back(canonical_spec(spec));
    }
  }
  if (!options.rays.empty()) {
    options.settings.rays.clear();
    for (const std::string& name : split_list("--rays", options.rays, ',')) {
      const RayKind kind = parse_ray_kind(name, all_ray_kinds());
      if (std::ranges::find(options.settings.rays, kind) == options.settings.rays.end()) options.settings.rays.push_back(kind);
    }
  }
}

/// Writes the files that were asked for.
void write_files(const CompareOptions& options, const Comparison& comparison) {
  if (!options.json.empty()) write_text_file(options.json, comparison_json(comparison).dump(1) + "\n");
  if (!options.csv.empty()) write_text_file(options.csv, comparison_csv(comparison));
}

/// Writes what is finished so far. A disk that is full may have room at the end; what was written before stays.
void save(const CompareOptions& options, const Comparison& so_far, const Console& console) {
  try {
    write_files(options, so_far);
  } catch (const OutputError& error) {
    console.warn(error.what());
  }
}

/// The structures at about the same memory; nothing when interrupted.
std::optional<ReportSection> match(const CompareOptions& options, const Scene& scene, const std::stop_token& stop) {
  const ComparisonSettings& settings = options.settings;
  std::vector<std::string> notes;
  const std::vector<std::string> specs = settings.structures.empty() ? default_specs(scene.primitive_count(), notes) : settings.structures;
  try {
    return matched_memory(scene, specs, settings.camera, settings.workload, settings.rounds, stop);
  } catch (const Stopped&) {
    return std::nullopt;
  }
}

/// What the comparison comes to, as an exit code.
int conclude(const Comparison& comparison) {
  std::fflush(stdout);
  const auto failed = std::ranges::count_if(comparison.rows, [](const ComparisonRow& row) { return !row.error.empty(); });
  if (!comparison.is_complete) {
    fmt::print(stderr, "grove compare: interrupted after {} of the rounds; the rows that are finished are kept\n", comparison.rounds);
    return kInterrupted;
  }
  if (failed == 0) return 0;
  fmt::print(stderr, "grove compare: {} of {} rows failed; the table says why\n", failed, comparison.rows.size());
  return kWorkFailed;
}

int run(CompareOptions& options, Interrupts& interrupts) {
  const Console console(options.quiet);
  read_lists(options);
  if (options.scale.is_asked) return run_scale(options.scale, options, options.settings, options.limits, interrupts);
  if (!options.json.empty()) check_writable(options.json);
  if (!options.csv.empty()) check_writable(options.csv);
  check_html(options, PageKind::report);
  const Scene scene = load(options.scene, console);

  TrialBuilder trials(options.scene, options.threads, options.limits, interrupts.token());
  if (options.limits.any()) options.settings.trial_build = [&](const std::string& spec) { return trials.try_build(spec); };

  const bool has_files = !options.json.empty() || !options.csv.empty() || !options.html.empty();
  options.settings.command = command_line();
  options.settings.heat_maps = !options.json.empty() || !options.html.empty();
  // With files, a signal ends the work after the step under way, and a second one ends it at once.
  std::optional<Interrupts::Graceful> graceful;
  if (has_files) graceful.emplace(interrupts);
  Comparison comparison;
  {
    ProgressBar bar("comparing", "rays", 1.0, options.quiet);
    std::function<void(const Comparison&)> save_so_far;
    if (has_files) save_so_far = [&](const Comparison& so_far) { save(options, so_far, console); };
    comparison = compare(scene, options.settings, bar.reporter(interrupts.token()), save_so_far);
  }
  if (!graceful) graceful.emplace(interrupts);
  console.say("");
  if (options.matches_memory && comparison.is_complete) {
    console.status("matching memory");
    comparison.matched_memory = match(options, scene, interrupts.token());
  }
  fmt::print("{}\n{}", comparison_table(comparison), comparison_advice(comparison));
  std::fflush(stdout);
  write_files(options, comparison);
  write_html(options, PageKind::report, "Structures on " + comparison.scene, comparison_json(comparison));
  return conclude(comparison);
}

}  // namespace

Verb add_compare(CLI::App& program) {
  const auto options = std::make_shared<CompareOptions>();
  CLI::App& verb = *program.add_subcommand("compare", "Build and trace several structures on the same scene and rays");
  ComparisonSettings& settings = options->settings;
  add_scene(verb, *options);
  verb.add_option("--structures", options->structures,
                  "Structures, the first the one to compare with (default: one per family and heuristic)")
      ->type_name("\"SPEC;SPEC\"");
  verb.add_option("--rays", options->rays, "Kinds of rays (default: primary,diffuse,shadow,random)")->type_name("KIND,KIND");
  in_range(verb.add_option("--rounds", settings.rounds, "Rounds to time; in each, every structure has its turn")
               ->type_name("K")
               ->capture_default_str(),
           std::uint64_t{1}, kMostRounds);
  in_range(verb.add_option("--count", settings.workload.ray_count, "Rays of each kind")->type_name("N")->capture_default_str(),
           std::uint64_t{1}, kMostRays);
  auto* const scale =
      verb.add_flag("--scale", options->scale.is_asked, "Run a built-in scene at many sizes, and fit how time, memory and steps grow");
  verb.add_option("--sizes", options->scale.sizes, "Numbers of primitives for --scale (default: 1k,3k,10k,30k,... up to --max)")
      ->type_name("N,N")
      ->needs(scale);
  verb.add_option("--max", options->scale.largest, "The largest of the default sizes for --scale")
      ->type_name("N")
      ->capture_default_str()
      ->needs(scale);
  verb.add_flag("--matched-memory", options->matches_memory,
                "Afterwards compare the structures with leaf sizes that make them take about the same memory");
  in_range(verb.add_option("--time-limit", settings.time_limit, "Seconds that building a structure, or tracing one kind of rays, may take")
               ->type_name("SECONDS"),
           1e-3, 1e6);
  verb.add_option("--memory-limit", options->memory_limit, "Memory that building a structure may take, such as 2GiB")->type_name("SIZE");
  in_range(verb.add_option("--seed", settings.workload.seed, "Another seed, other rays")->type_name("S")->capture_default_str(),
           std::uint64_t{0}, std::numeric_limits<std::uint64_t>::max());
  verb.add_option("--camera", settings.camera, "Camera of the scene for primary rays (default: its first, else a view of everything)")
      ->type_name("NAME");
  add_threads(verb, *options);
  add_json(verb, *options, "machine and rows");
  verb.add_option("--csv", options->csv, "Write the rows to this file as comma-separated values")->type_name("FILE");
  add_html(verb, *options, "machine and rows");
  add_quiet(verb, *options);
  verb.footer(
      "Every hit is checked against brute force (a sample of the rays on large scenes) before anything is timed. Figures are medians\n"
      "over the rounds, with the least and the most.\n\n"
      "Examples:\n"
      "  grove compare builtin:sphereflake\n"
      "  grove compare scene.glb --structures \"bvh;bvh:leaf-size=8\" --rays primary,random --rounds 9\n"
      "  grove compare builtin:mount --scale --max 1M\n"
      "  grove compare builtin:cornell --count 100000 --threads 1 --json compare.json --html compare.html");
  return {&verb, [options](Interrupts& interrupts) { return with_threads(options->threads, [&] { return run(*options, interrupts); }); }};
}

}  // namespace grove::app
