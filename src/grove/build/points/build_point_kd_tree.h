#pragma once

#include <span>

#include "grove/accel/point_kd_tree.h"

namespace grove {

/// Builds a kd-tree over points of K dimensions, 2 to 16, from the root down: each set is parted at the median along the axis on which it is widest (Friedman,
/// Bentley and Finkel 1977). Points are numbered as they stand in `points`; those with a coordinate that is not a number or beyond kMaxPointCoordinate are
/// left out. O(n log n) time and 4 K + 4 bytes a point for a while, in parallel in the caller's oneTBB arena; the same, bit for bit, for any number of
/// threads. Throws InputError for 2^32 - 1 points or more.
template <std::size_t kDimensions>
[[nodiscard]] PointKdTree<kDimensions> build_point_kd_tree(std::span<const Point<kDimensions>> points);

}  // namespace grove
