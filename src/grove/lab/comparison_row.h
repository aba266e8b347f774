#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "grove/lab/ray_work.h"
#include "grove/lab/spread.h"
#include "grove/lab/workload.h"

namespace grove {

/// How a structure follows its geometry when every vertex may have moved and none has been added.
struct UpdateTrial {
  UpdateMethod method = UpdateMethod::rebuild;
  double seconds = 0.0;
};

/// One structure on one kind of rays.
struct ComparisonRow {
  std::string structure;  ///< canonical spec
  std::string rays;       ///< the kind, for recorded rays with the bounce
  /// Rays that were traced: all, or for brute force an even sample of them where all would take long.
  std::size_t ray_count = 0;
  /// Why the row has no times: the structure could not be built or traced, is over a limit, or its hits are wrong. Empty when all is well.
  std::string error;
  Spread mrays_per_s;
  /// Rate over the rate of the first structure on the same rays in the same round. Zero when that has none.
  Spread ratio_to_first;
  Spread build_seconds;             ///< by all threads of the caller's arena
  Spread build_seconds_one_thread;  ///< of the first rounds; with one thread the same as build_seconds
  std::uint64_t bytes = 0;          ///< of the structure, without the geometry
  double expected_cost = 0.0;
  std::uint64_t references = 0;
  std::uint64_t nodes = 0;
  std::uint64_t leaves = 0;
  std::uint32_t depth = 0;
  /// Of SceneAccelerator::measure_quality; missing where it is.
  std::optional<double> end_point_overlap;
  std::optional<double> sibling_overlap;
  /// References over primitives that are referenced.
  std::optional<double> duplication;
  /// A refit of the object with the most primitives, where there is one; else building anew.
  std::optional<UpdateTrial> update;
  RayWork work;
  std::uint64_t mismatches = 0;  ///< rays whose hit is not the reference's, bit for bit
  /// Whether the structure was built and described; whether the rays were traced and `work` and `mismatches` are known.
  bool is_described = false;
  bool is_counted = false;

  [[nodiscard]] double nodes_per_ray() const { return work.nodes.mean; }
  [[nodiscard]] double tests_per_ray() const { return work.tests.mean; }
  [[nodiscard]] double nanoseconds_per_ray() const { return is_timed() ? 1e3 / mrays_per_s.median : 0.0; }
  /// Whether times were taken; an interrupted comparison has rows without.
  [[nodiscard]] bool is_timed() const { return error.empty() && mrays_per_s.median > 0.0; }
  [[nodiscard]] bool is_built() const { return build_seconds.median > 0.0; }
};

/// Fills in what does not depend on the rays.
void describe_structure(const SceneAccelerator& accelerator, ComparisonRow& row);

/// Builds the structure over the object with the most primitives and refits it. Empty where it has no refit, and for a scene without objects.
[[nodiscard]] std::optional<UpdateTrial> try_update(const Scene& scene, const std::string& spec);

}  // namespace grove
