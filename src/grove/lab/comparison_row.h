#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "grove/lab/spread.h"
#include "grove/lab/workload.h"

namespace grove {

/// One structure on one kind of rays.
struct ComparisonRow {
  std::string structure;  ///< canonical spec
  RayKind rays = RayKind::primary;
  /// Rays that were traced: all, or for brute force an even sample of them where all would take long.
  std::size_t ray_count = 0;
  /// Why the row has no times: the structure could not be built or traced, or its hits are wrong. Empty when all is well.
  std::string error;
  Spread mrays_per_s;
  /// Rate over the rate of the first structure on the same rays in the same round. Zero when that has none.
  Spread ratio_to_first;
  double nodes_per_ray = 0.0;
  double tests_per_ray = 0.0;
  Spread build_seconds;
  std::uint64_t bytes = 0;  ///< of the structure, without the geometry
  double expected_cost = 0.0;
  std::uint64_t references = 0;
  std::uint64_t nodes = 0;
  std::uint64_t leaves = 0;
  std::uint32_t depth = 0;
  /// Of SceneAccelerator::measure_quality; missing where it is.
  std::optional<double> end_point_overlap;
  std::optional<double> sibling_overlap;
  std::uint64_t mismatches = 0;  ///< rays whose hit is not the reference's, bit for bit

  /// Whether times were taken; an interrupted comparison has rows without.
  [[nodiscard]] bool is_timed() const { return error.empty() && mrays_per_s.median > 0.0; }
  [[nodiscard]] bool is_built() const { return build_seconds.median > 0.0; }
  /// Whether the rays were traced at all.
  [[nodiscard]] bool is_counted() const { return nodes_per_ray + tests_per_ray > 0.0 || error.empty(); }
};

/// Fills in what does not depend on the rays.
void describe_structure(const StructureStatistics& statistics, const StructureQuality& quality, ComparisonRow& row);

}  // namespace grove
