#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "grove/geometry/traversal_counts.h"

namespace grove {

/// How a count lies over rays.
struct CountSpread {
  double mean = 0.0;
  std::uint64_t p95 = 0;  ///< the least count that at least 95 % of the rays do not exceed
  std::uint64_t max = 0;

  friend bool operator==(const CountSpread&, const CountSpread&) = default;
};

/// Rays that took `first` steps or more, and fewer than the next bin's.
struct StepsBin {
  std::uint64_t first = 0;
  std::uint64_t rays = 0;

  friend bool operator==(const StepsBin&, const StepsBin&) = default;
};

/// What each of many rays did. A step is a node visited or a primitive tested.
struct RayWork {
  CountSpread nodes;
  CountSpread tests;
  /// Bins begin at 0, 1, 2, 3, 4, 6, 8, 12, 16 and so on, two to each power of two; the first and the last are not empty, but for no rays at all.
  std::vector<StepsBin> steps;
};

/// O(n). All zero for no rays.
[[nodiscard]] RayWork work_of(std::span<const TraversalCounts> counts);

}  // namespace grove
