#pragma once

#include <cstdint>
#include <vector>

#include "grove/accel/bvh2.h"
#include "grove/build/passes/collapse.h"

namespace grove {

/// A node of a wide hierarchy that is planned but not laid out.
struct PlannedNode {
  static constexpr std::uint32_t kNoSlot = 0xffffffffU;

  std::uint32_t slot[8];  ///< the children among the slots of the binary hierarchy, as CollapsePlan::Child::slot; unused places are kNoSlot
  std::uint32_t first[8];  ///< of a leaf its first reference; else the number of a node of the same piece, or of a piece
  std::uint8_t count[8];   ///< references of a leaf, 0 for a node
};

/// Nodes of one subtree in depth-first order, or a single node over other pieces.
struct PlannedPiece {
  std::vector<PlannedNode> nodes;
  bool is_over_pieces = false;  ///< whether `first` of its node's children names pieces, each of which begins with the child
  std::uint32_t block_count = 0;
  std::uint32_t depth = 0;        ///< of its deepest leaf in the whole hierarchy
  std::uint32_t first_node = 0;   ///< in the whole hierarchy
  std::uint32_t first_block = 0;  ///< in the whole hierarchy, where each leaf is a block and those of a node follow each other
};

/// The nodes that `plan` makes of `bvh`, in pieces that follow each other in depth-first order. The root must not be a leaf. Pieces are listed in parallel;
/// which there are does not depend on the threads. O(nodes).
[[nodiscard]] std::vector<PlannedPiece> list_planned_nodes(const Bvh2& bvh, const CollapsePlan& plan);

}  // namespace grove
