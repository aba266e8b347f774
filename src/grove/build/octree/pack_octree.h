#pragma once

#include <functional>

#include "grove/accel/octree.h"
#include "grove/build/octree/octree_draft.h"

namespace grove {

/// Copies a draft to an octree, parts in parallel: children and leaves of a node in a row, nodes in depth-first order of their parents. `bounds` and `cell` are the
/// tree's; `before` is the octree that kept subtrees are of, if there are any. Throws InputError where there are 2^29 nodes or leaves, or more than 2^32 - 2 references.
[[nodiscard]] Octree pack_octree(const OctreeDraft& draft, const Box& bounds, const Box& cell, const Octree* before = nullptr);

}  // namespace grove
