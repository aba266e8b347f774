#pragma once

// Tree rotations: Kopta, Ize, Spjut, Brunvand, Davis, Kensler, "Fast, Effective BVH Updates for Animated Scenes" (2012). From the leaves up,
// each node may exchange a child with a grandchild on its other side, or two grandchildren with each other, where that lowers the area of the
// boxes between. Run after a refit it keeps up with deformation for the price of another pass over the nodes.
//
// Differences from the paper: one pass of its own after the refit instead of one fused with it, and no rotation that would make the
// hierarchy deeper than traversals allow.

#include <cstdint>
#include <span>

#include "grove/accel/bvh2.h"
#include "grove/build/cost_model.h"

namespace grove {

struct Rotated {
  double cost = 0.0;            ///< expected cost after it
  std::uint64_t rotations = 0;  ///< how many were made
};

/// Improves `bvh` in place, whose boxes must be right. Never raises its cost. Nodes keep their numbers, except that they then need not stand in
/// depth-first order, and leaves stay what they are. Where `changed` is not empty it must have an entry for each node, and
/// changed[i] becomes 1 where node i no longer stands over the same references. O(nodes), parallel; the same for any number of threads.
Rotated rotate(Bvh2& bvh, const CostModel& cost = {}, std::span<std::uint8_t> changed = {});

}  // namespace grove
