#pragma once

// Parallel locally-ordered clustering: Meister and Bittner, "Parallel Locally-Ordered Clustering for Bounding Volume Hierarchy Construction" (2018),
// with the single pass over each pair of neighbours of Benthin et al., "PLOC++" (2022). Clusters, at first single references, stand in Morton order. In each
// round every cluster finds the one within `radius` places whose joint box has the least area; those that choose each other become one.
//
// Equal areas prefer the partner whose place differs in the last bit, so that identical primitives halve in each round.
//
// Differences from the papers: the last 1,024 clusters, and whatever is left after 32 rounds, are split from the top by the exact heuristic (by bins
// beyond 65,536), as HLBVH does (Pantaleoni and Luebke 2010). Near the root neighbours along the curve are few and far apart, and a single large primitive that joins the
// wrong ones is dear: cost falls by 3 % on a terrain, by a third on a kitchen and on a tree over a ground plane (docs/bvh.md). It also bounds
// depth and time for any input.

#include "grove/accel/bvh2.h"
#include "grove/build/bottom_up/bottom_up_settings.h"
#include "grove/build/primitive_reference.h"

namespace grove {

/// O(radius n) time for each of at most 32 rounds, in practice about 2.5 radius n in all, and O(n log^2 n) for what they leave; the same for any number of threads.
[[nodiscard]] Bvh2 build_ploc(ReferenceList list, const BottomUpSettings& settings);

}  // namespace grove
