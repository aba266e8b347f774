#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "grove/scene/scene.h"

namespace grove {

/// What parting a set of primitives at a plane would cost, by both forms of the surface-area heuristic, for one ray that meets the set's box.
struct SplitCost1D {
  double position = 0.0;  ///< of the plane on the axis; primitives go by their centres
  std::uint64_t left = 0;
  std::uint64_t right = 0;
  /// Today's form: one step, and the tests of each side by the chance of meeting its box.
  double standard = 0.0;
  /// Equation 2 of the review as written: for each side, by that chance, the time t_i of traversing its subtree and its tests (SubsetTime).
  double equation_2 = 0.0;
};

/// The candidates on one axis, from low to high, and the two medians between which the best plane is said to lie (MacDonald and Booth 1990).
struct SplitCostCurve {
  int axis = 0;
  double spatial_median = 0.0;
  double object_median = 0.0;
  std::vector<SplitCost1D> planes;
};

/// The costs of parting the object of a scene that has most primitives, in its own space, at `plane_count` equally spaced planes inside its
/// box on each axis. Planes that leave a side empty are left out. O(n log n).
[[nodiscard]] std::vector<SplitCostCurve> split_cost_curves(const Scene& scene, unsigned plane_count);

/// axis,position,left,right,standard,equation_2,spatial_median,object_median: a row for each plane.
[[nodiscard]] std::string split_costs_csv(const std::vector<SplitCostCurve>& curves);

}  // namespace grove
