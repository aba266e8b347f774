#pragma once

#include <cstdint>
#include <vector>

#include "grove/accel/bvh2.h"
#include "grove/build/cost_model.h"

namespace grove {

/// What each subtree of a binary hierarchy costs: the figures by which an update decides what to rebuild.
struct SubtreeCosts {
  std::vector<float> per_entry;           ///< of each node: expected cost for a ray that meets its box; 0 where that has no area
  std::vector<float> area;                ///< of each node: scaled half area of its box
  std::vector<std::uint32_t> references;  ///< below each node
  double total = 0.0;                     ///< expected cost of the hierarchy
};

/// Measures `bvh`, whose boxes must be right; its nodes may stand in any order. O(nodes), parallel; the same for any number of threads.
[[nodiscard]] SubtreeCosts measure_subtree_costs(const Bvh2& bvh, const CostModel& cost = {});

}  // namespace grove
