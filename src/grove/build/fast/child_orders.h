#pragma once

#include <cstdint>

#include "grove/accel/fast_node.h"

namespace grove {

/// For each octant of direction the places of a node's children from far to near by where the centres of their boxes lie along the octant's diagonal,
/// as FastNode::order has them. The first `count` places are in use, 1 to 8; the others come first. Ties in the order of places.
void order_children(const EightBoxes& boxes, int count, std::uint32_t orders[8]);

}  // namespace grove
