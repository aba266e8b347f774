#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "grove/base/progress.h"
#include "grove/lab/comparison_row.h"
#include "grove/lab/heat_map.h"
#include "grove/lab/machine.h"
#include "grove/lab/report_section.h"
#include "grove/lab/workload.h"
#include "grove/registry/choose_structure.h"

namespace grove {

struct ComparisonSettings {
  /// Specs; the first is what the others are set against. Empty: `default_specs`.
  std::vector<std::string> structures;
  /// `recorded` makes a row for all such rays and one for each bounce.
  std::vector<RayKind> rays{ray_kinds().begin(), ray_kinds().end()};
  WorkloadSettings workload;
  /// How often each structure is built and traced for the clock, at least 1.
  unsigned rounds = 5;
  /// As RenderSettings::camera.
  std::string camera;
  /// Ray-primitive tests that checking by brute force may take, for each kind of rays.
  std::uint64_t check_budget = 20'000'000;
  /// Seconds that tracing one kind of rays may take a structure; 0 for any. More makes a row that says so.
  double time_limit = 0.0;
  /// Why a structure may not be built, or nothing; asked before it is built, in the calling thread. What it says becomes rows with an error. May throw Stopped (structure_trial.h), and be empty.
  std::function<std::string(const std::string& spec)> trial_build;
  /// The command that was given; for the reader.
  std::string command;
  /// Draws a picture of the steps of camera rays for each structure.
  bool heat_maps = false;
};

struct Comparison {
  std::string scene;
  std::uint64_t primitives = 0;  ///< every instance counted
  std::uint64_t instances = 0;
  std::size_t ray_count = 0;  ///< of each kind
  unsigned rounds = 0;
  /// Rays of each kind that brute force has answered, the fewest of any; the others are checked against the first structure.
  std::uint64_t reference_rays = 0;
  Machine machine;
  std::string command;       ///< of the settings
  std::string date;          ///< of the end, or of the last save: ISO 8601, UTC
  bool is_complete = false;  ///< whether every structure had its turn in every round
  /// By kind of rays, then in the order of the structures. Structures that have not been looked at yet have none.
  std::vector<ComparisonRow> rows;
  std::vector<HeatMap> heat_maps;
  /// What `auto` would have taken; nothing for a scene without objects.
  std::optional<StructureChoice> auto_choice;
  /// See matched_memory.h; not made by `compare`.
  std::optional<ReportSection> matched_memory;
  /// What a reader should know, such as a structure that was left out. One line each.
  std::vector<std::string> notes;
};

/// The specs that stand for all families and heuristics; brute force only for scenes so small that a fair number of rays is soon traced.
/// Adds a line to `notes` when it is left out.
[[nodiscard]] std::vector<std::string> default_specs(std::uint64_t primitive_count, std::vector<std::string>& notes);

/// Builds each structure over `scene` and traces each kind of rays with it. All hits are checked, all work is counted and quality is measured first; then
/// building and tracing are timed, interleaved: in each round every structure in turn, so that what disturbs the machine disturbs all of
/// them. Only one structure is in memory at a time. Runs in the caller's oneTBB arena. A structure that fails keeps its rows, with the
/// reason. Progress counts rays. `save` is called with what is known so far, when a structure has been checked and after each round. When
/// `progress.stop` asks, returns after the step under way, with the rounds that were finished. Throws UsageError for a bad spec or camera.
[[nodiscard]] Comparison compare(const Scene& scene, const ComparisonSettings& settings, const ProgressReporter& progress = {},
                                 const std::function<void(const Comparison&)>& save = {});

}  // namespace grove
