#pragma once

// Parallel reinsertion: Meister and Bittner, "Parallel Reinsertion for Bounding Volume Hierarchy Optimization" (2018). Subtrees are taken out of a
// binary hierarchy and put back where that lowers the sum of the areas of all interior boxes most. In each round the best place is looked
// for in parallel, for many subtrees at once, in the hierarchy as it stands; then the moves are made one after another in the order of
// their gain, leaving out those that an earlier move has got in the way of.
//
// Differences from the paper: the search descends depth first with a stack; conflicts are resolved by making the moves serially, which costs
// little beside the search and gives the same hierarchy for any number of threads; and a move under a subtree that has itself been moved into
// the one to be moved, which would tie a knot, is recognised by walking up from the target.

#include <cstdint>

#include "grove/accel/bvh2.h"

namespace grove {

struct ReinsertionSettings {
  std::uint32_t rounds = 16;
  /// In a round, one subtree in so many is tried.
  std::uint32_t stride = 4;
  /// Where not 0: instead, about this share of the subtrees is tried in each round, those whose boxes have the largest areas. A good part of what there is
  /// to gain is there.
  double largest = 0.0;
  /// Rounds end when a full turn over all subtrees, or one round over the largest, has lowered the sum of areas by less than this share.
  double least_gain = 0.002;
};

/// Improves `bvh`, which need not be in depth-first order; the result is. The sum of the areas of interior boxes never grows. References and leaves
/// stay what they are, in another order. Deterministic for any number of threads. Memory: 110 bytes a node for a while.
[[nodiscard]] Bvh2 optimize_by_reinsertion(const Bvh2& bvh, const ReinsertionSettings& settings = {});

}  // namespace grove
