#pragma once

#include <cstdint>

#include "grove/build/cost_model.h"

namespace grove {

/// How a cell is parted.
enum class KdSplit : std::uint8_t {
  sah,             ///< the cheapest plane of all, by exact events
  binned,          ///< the cheapest of a few planes between bins
  object_median,   ///< as many primitives on one side as on the other
  spatial_median,  ///< in the middle of the longest side
};

struct KdTreeSettings {
  KdSplit split = KdSplit::sah;
  /// Bound what of a primitive lies in a cell exactly ("perfect splits"), not by its box.
  bool clip = true;
  /// By how much of itself the cost of a plane falls that cuts off empty space. In [0, 1).
  float empty_bonus = 0.2F;
  /// No leaf is deeper; 0 for 8 + 1.3 log2 n (Pharr and Humphreys 2004, "Physically Based Rendering"). At most KdTree::kMaxDepth.
  std::uint32_t most_depth = 0;
  /// Sets of at most this many primitives are not parted. At least 1.
  std::uint32_t leaf_size = 1;
  /// The ratio that serves hierarchies.
  CostModel cost = {};
  /// How many planes above each other may cost more than not parting at all, in the hope of better ones below.
  std::uint32_t bad_planes = 3;
  /// At most so many references are made, as a multiple of the primitives. At least 1.
  double most_references = 8.0;
};

}  // namespace grove
