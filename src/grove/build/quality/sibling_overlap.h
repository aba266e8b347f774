#pragma once

#include "grove/build/quality/preorder_nodes.h"

namespace grove {

/// How much the children of a node are in each other's way: the sum over interior nodes of the areas of the common parts of each two of their children's
/// boxes, over the sum of the areas of the interior nodes' own boxes. For two children a node that is the chance that a random ray, at a node that it
/// meets, also meets the part where it must enter both; with more children, how many such pairs there are on average.
///
/// 0 where no children meet, 1 where both always have their parent's box. Boxes are closed: the common part of neighbours is the face they share.
/// 0 as well without interior nodes or where they have no area. O(nodes * arity).
[[nodiscard]] double sibling_overlap(const PreorderNodes& hierarchy);

}  // namespace grove
