#pragma once

#include "grove/accel/kd_ropes.h"
#include "grove/accel/kd_tree.h"

namespace grove {

/// Makes the ropes of a tree, and its leaves refer to them. Each rope is pushed down the tree behind it as far as one node has the whole face
/// (Popov et al. 2007, section 3.1). O(nodes * depth) at most, in parallel; the same for any number of threads. Empty for an empty tree.
[[nodiscard]] KdRopes add_ropes(KdTree& tree);

/// Takes ropes away again: the leaves of the tree refer to their references as before.
void remove_ropes(KdTree& tree, const KdRopes& ropes);

}  // namespace grove
