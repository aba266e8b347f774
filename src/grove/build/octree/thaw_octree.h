#pragma once

#include <vector>

#include "grove/accel/octree.h"
#include "grove/build/octree/octree_draft.h"

namespace grove {

/// Turns an octree back into a draft without the primitives for which `is_removed` is true, so that others can be put in. Nodes and leaves that lost none are
/// marked as kept. DraftNode::count is exact up to `largest_leaf`, which is what deciding on leaves takes; above, it is the number of references. What has nothing
/// left is an empty octant. In parallel in the caller's oneTBB arena; the same for any number of threads. O(nodes + references).
[[nodiscard]] OctreeDraft thaw_octree(const Octree& tree, const std::vector<bool>& is_removed, std::uint32_t largest_leaf);

}  // namespace grove
