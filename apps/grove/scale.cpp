#include "scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <nlohmann/json.hpp>

#include "command_line.h"
#include "grove/base/error.h"
#include "grove/base/output_file.h"
#include "grove/lab/scale_report.h"
#include "html_file.h"
#include "progress_bar.h"
#include "session.h"
#include "verbs.h"

namespace grove::app {
namespace {

constexpr std::uint64_t kMostPrimitives = 200'000'000;

/// "10000", "10k" or "2M".
std::uint64_t parse_count(const std::string& option, const std::string& text) {
  std::uint64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  const std::string unit(stop, end);
  const std::uint64_t factor = unit.empty() ? 1 : unit == "k" ? 1000 : unit == "M" ? 1'000'000 : 0;
  if (error != std::errc() || factor == 0 || number == 0 || number > kMostPrimitives / factor)
    throw UsageError(fmt::format("{}: '{}' is not a number of primitives from 1 to 200M; write 5000, 10k or 2M", option, text));
  return number * factor;
}

std::vector<std::uint64_t> sizes_of(const ScaleOptions& scale) {
  if (scale.sizes.empty()) return scale_sizes(parse_count("--max", scale.largest));
  std::vector<std::uint64_t> sizes;
  for (const std::string& size : split_list("--sizes", scale.sizes, ',')) sizes.push_back(parse_count("--sizes", size));
  std::ranges::sort(sizes);
  return sizes;
}

ScaleSettings settings_for(const ScaleOptions& scale, const CommonOptions& common, const ComparisonSettings& comparison) {
  ScaleSettings settings;
  settings.scene = common.scene;
  settings.sizes = sizes_of(scale);
  if (settings.sizes.empty()) throw UsageError("--max: with less than 1k there are no sizes to go through; name them with --sizes");
  settings.structures = comparison.structures.empty() ? scale_specs() : comparison.structures;
  if (comparison.rays.size() == 1) settings.rays = comparison.rays.front();
  if (settings.rays == RayKind::recorded)
    throw UsageError("--rays: recorded rays are not for --scale; choose primary, diffuse, shadow or random");
  settings.rounds = std::min(comparison.rounds, settings.rounds);
  settings.workload.ray_count = std::min(comparison.workload.ray_count, settings.workload.ray_count);
  settings.workload.seed = comparison.workload.seed;
  settings.command = command_line();
  return settings;
}

int conclude(const ScaleStudy& study) {
  std::fflush(stdout);
  if (!study.is_complete) {
    fmt::print(stderr, "grove compare: interrupted; the sizes that are finished are kept\n");
    return kInterrupted;
  }
  const auto failed = std::ranges::count_if(study.rows, [](const ScaleRow& row) { return !row.error.empty(); });
  if (failed == 0) return 0;
  fmt::print(stderr, "grove compare: {} of {} rows failed; the table says why\n", failed, study.rows.size());
  return kWorkFailed;
}

}  // namespace

int run_scale(const ScaleOptions& scale, const CommonOptions& common, const ComparisonSettings& comparison, const BuildLimits& limits,
              Interrupts& interrupts) {
  const Console console(common.quiet);
  ScaleSettings settings = settings_for(scale, common, comparison);
  if (!common.json.empty()) check_writable(common.json);
  check_html(common, PageKind::report);
  // One process for each scene that builds are tried over.
  std::unique_ptr<TrialBuilder> trials;
  std::string tried;
  if (limits.any()) {
    settings.trial_build = [&](const std::string& scene, const std::string& spec) {
      if (tried != scene) trials = std::make_unique<TrialBuilder>(scene, common.threads, limits, interrupts.token());
      tried = scene;
      return trials->try_build(spec);
    };
  }
  const auto save = [&](const ScaleStudy& so_far) {
    if (common.json.empty()) return;
    try {
      write_text_file(common.json, scale_json(so_far).dump(1) + "\n");
    } catch (const OutputError& error) {
      console.warn(error.what());
    }
  };
  std::optional<Interrupts::Graceful> graceful;
  if (!common.json.empty() || !common.html.empty()) graceful.emplace(interrupts);
  ScaleStudy study;
  {
    ProgressBar bar("growing", "structures", 1.0, common.quiet);
    study = study_scale(settings, save, bar.reporter(interrupts.token()));
  }
  if (!graceful) graceful.emplace(interrupts);
  fmt::print("{}", scale_text(study));
  std::fflush(stdout);
  if (!common.json.empty()) write_text_file(common.json, scale_json(study).dump(1) + "\n");
  write_html(common, PageKind::report, "Growth on " + study.scene, scale_json(study));
  return conclude(study);
}

}  // namespace grove::app
