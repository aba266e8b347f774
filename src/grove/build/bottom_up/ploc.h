#pragma once

// Parallel locally-ordered clustering: Meister and Bittner, "Parallel Locally-Ordered Clustering for Bounding Volume Hierarchy Construction" (2018),
// with the single pass over each pair of neighbours of Benthin et al., "PLOC++" (2022). Clusters, at first single references, stand in Morton order. In each
// round every cluster finds the one within `radius` places whose joint box has the least area; those that choose each other become one.
//
// Equal areas prefer the partner whose place differs in the last bit, so that identical primitives halve in each round. After 64 rounds,
// which real scenes do not reach, places are paired without looking, which bounds depth (by 64 + 31) and time.

#include "grove/accel/bvh2.h"
#include "grove/build/bottom_up/emit.h"

namespace grove {

/// O(radius n) time for each of at most 64 rounds, in practice about 2.5 radius n in all; the same for any number of threads.
[[nodiscard]] Bvh2 build_ploc(const ReferenceList& list, const BottomUpSettings& settings);

}  // namespace grove
