#pragma once

#include <functional>

#include "grove/accel/octree.h"
#include "grove/build/octree/octree_draft.h"

namespace grove {

/// Copies a draft to an octree, parts in parallel: children and leaves of a node in a row, nodes in depth-first order of their parents. `bounds` and `cell` are the
/// tree's. Throws InputError where there are more than 2^30 nodes or leaves, or 2^32 - 2 references.
[[nodiscard]] Octree pack_octree(const OctreeDraft& draft, const Box& bounds, const Box& cell);

}  // namespace grove
