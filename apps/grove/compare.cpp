#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "grove/base/error.h"
#include "grove/base/output_file.h"
#include "grove/lab/comparison.h"
#include "grove/lab/comparison_report.h"
#include "html_file.h"
#include "progress_bar.h"
#include "session.h"
#include "verbs.h"

namespace grove::app {
namespace {

constexpr std::uint64_t kMostRounds = 10'000;
constexpr std::uint64_t kMostRays = 100'000'000;

struct CompareOptions : CommonOptions {
  std::string structures;
  std::string rays;
  std::filesystem::path csv;
  ComparisonSettings settings;
};

void read_lists(CompareOptions& options) {
  if (!options.structures.empty()) {
    for (const std::string& spec : split_list("--structures", options.structures, ';')) {
      options.settings.structures.push_back(canonical_spec(spec));
    }
  }
  if (!options.rays.empty()) {
    options.settings.rays.clear();
    for (const std::string& name : split_list("--rays", options.rays, ',')) {
      const RayKind kind = parse_ray_kind(name);
      if (std::ranges::find(options.settings.rays, kind) == options.settings.rays.end()) options.settings.rays.push_back(kind);
    }
  }
}

int run(CompareOptions& options, Interrupts& interrupts) {
  const Console console(options.quiet);
  read_lists(options);
  if (!options.json.empty()) check_writable(options.json);
  if (!options.csv.empty()) check_writable(options.csv);
  check_html(options, PageKind::report);
  const Scene scene = load(options.scene, console);

  Comparison comparison;
  {
    ProgressBar bar("comparing", "rays", 1.0, options.quiet);
    comparison = compare(scene, options.settings, bar.reporter(interrupts.token()));
  }
  // What is being written is finished first; a second signal ends it.
  const Interrupts::Graceful graceful(interrupts);
  console.say("");
  fmt::print("{}", comparison_table(comparison));
  if (!options.json.empty()) write_text_file(options.json, comparison_json(comparison).dump(2) + "\n");
  if (!options.csv.empty()) write_text_file(options.csv, comparison_csv(comparison));
  write_html(options, PageKind::report, "Structures on " + comparison.scene, comparison_json(comparison));
  const auto failed = std::ranges::count_if(comparison.rows, [](const ComparisonRow& row) { return !row.error.empty(); });
  if (failed == 0) return 0;
  std::fflush(stdout);
  fmt::print(stderr, "grove compare: {} of {} rows failed; the table says why\n", failed, comparison.rows.size());
  return kWorkFailed;
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
      "  grove compare builtin:cornell --count 100000 --threads 1 --json compare.json --html compare.html");
  return {&verb, [options](Interrupts& interrupts) { return with_threads(options->threads, [&] { return run(*options, interrupts); }); }};
}

}  // namespace grove::app
