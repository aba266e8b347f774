#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "grove/base/huge_vector.h"
#include "grove/math/box.h"

namespace grove {

/// How many of the eight bits of a mask are set: by a table, since the baseline instruction set has no instruction for it.
[[nodiscard]] inline std::uint32_t count_octants(std::uint32_t mask) {
  static constexpr std::array<std::uint8_t, 256> kCounts = [] {
    std::array<std::uint8_t, 256> counts{};
    for (std::size_t i = 1; i < 256; ++i) counts[i] = static_cast<std::uint8_t>(counts[i / 2] + i % 2);
    return counts;
  }();
  return kCounts[mask];
}

/// An interior node of an octree: three planes, one across each axis, and eight octants. Bit a of an octant's number (1 for x, 2 for y, 4 for z) is set
/// where it lies above the plane across axis a. An octant is an interior node, a leaf, or empty, which costs no memory.
///
///   bytes  0..11  planes across x, y and z
///   bytes 12..15  number of the first child that is an interior node; the others follow in order of octant
///   bytes 16..19  number of the first leaf: the node's own references where it has any, then the children that are leaves, in order of octant
///   byte  20      bit o: octant o is an interior node
///   byte  21      bit o: octant o is a leaf
///   byte  22      1 where the node has references of its own, else 0
///   byte  23      bit a: the cell is cut across axis a; where it is not, the plane is the cell's upper end
struct OctreeNode {
  float planes[3];
  std::uint32_t first_child;
  std::uint32_t first_leaf;
  std::uint8_t interior_mask;
  std::uint8_t leaf_mask;
  std::uint8_t has_own;
  std::uint8_t cut_axes;

  /// The interior node in an octant that is one.
  [[nodiscard]] std::uint32_t child(std::uint32_t octant) const {
    return first_child + count_octants(interior_mask & ((1U << octant) - 1));
  }
  /// The leaf in an octant that is one.
  [[nodiscard]] std::uint32_t leaf(std::uint32_t octant) const {
    return first_leaf + has_own + count_octants(leaf_mask & ((1U << octant) - 1));
  }
  [[nodiscard]] std::uint32_t leaf_count() const { return has_own + count_octants(leaf_mask); }

  [[nodiscard]] Box octant_cell(const Box& cell, std::uint32_t octant) const {
    Box part = cell;
    for (int axis = 0; axis < 3; ++axis) ((octant >> axis & 1U) != 0 ? part.lower : part.upper)[axis] = planes[axis];
    return part;
  }

  friend bool operator==(const OctreeNode&, const OctreeNode&) = default;
};

static_assert(sizeof(OctreeNode) == 24);

/// An octree, as plain data: cells that are cut in eight again and again until few primitives reach into them. The form is the same whether the planes
/// are in the middle (octree) or elsewhere (octree-R), and whether primitives are referenced in leaves or in inner nodes.
///
/// Node 0 is the root; what is never cut is a root with references of its own and no children. Nodes and leaves are numbered depth first: the children of a node, then
/// what is below the first of them, then the second, and so on; so what is below a node is in a row. References are those of leaf 0, leaf 1 and so on, so
/// that a leaf is no more than where its references begin. Cells are closed: a plane belongs to both sides. Each point
/// of a primitive inside `bounds` lies in the cell of a leaf, or of a node with own references, that refers to the primitive. An empty tree has no nodes.
/// Knows boxes and primitive ids, no geometry.
struct Octree {
  /// Builders never go deeper, so traversals keep their stack in an array: at most seven octants wait at each level.
  static constexpr std::uint32_t kMaxDepth = 24;

  HugeVector<OctreeNode> nodes;
  HugeVector<std::uint32_t> leaf_first;  ///< where the references of each leaf begin, and one more entry: where the last end
  HugeVector<std::uint32_t> references;  ///< primitive ids, leaf by leaf; ascending within one
  Box bounds;                            ///< of the primitives; empty when there are no references
  Box cell;                              ///< of the root: around `bounds`; a cube for octrees with planes in the middle
  std::uint32_t depth = 0;               ///< edges from the root to the deepest leaf

  [[nodiscard]] std::uint32_t leaf_count() const { return leaf_first.empty() ? 0 : static_cast<std::uint32_t>(leaf_first.size() - 1); }
  /// Bytes kept for tracing.
  [[nodiscard]] std::size_t memory() const {
    return nodes.size() * sizeof(OctreeNode) + (leaf_first.size() + references.size()) * sizeof(std::uint32_t);
  }

  /// The first broken invariant in words, or an empty string: each plane inside its cell, each node and leaf reached once and in the order stated above, no
  /// empty leaf, ids ascending within a leaf and below `primitive_count`, `depth` as found. O(nodes + references).
  [[nodiscard]] std::string validate(std::size_t primitive_count) const;

  /// The nodes below a node, and its leaves and theirs.
  struct Below {
    std::uint32_t first_node, end_node;
    std::uint32_t first_leaf, end_leaf;
  };
  /// O(depth).
  [[nodiscard]] Below below(std::uint32_t number) const {
    const OctreeNode* last = &nodes[number];
    Below below{last->first_child, 0, last->first_leaf, 0};
    // What comes last is below the last child, and ends where a node without children says that its children would be.
    while (last->interior_mask != 0) last = &nodes[last->first_child + count_octants(last->interior_mask) - 1];
    below.end_node = last->first_child;
    below.end_leaf = last->first_leaf + last->leaf_count();
    return below;
  }

  /// A node, or a set of references, as `visit` shows them.
  struct Visited {
    Box cell;
    std::uint32_t depth;
    std::uint32_t node;  ///< the node, or the one that the leaf belongs to
    bool is_leaf;        ///< the rest only for leaves; a node's own references are shown as a leaf over all of its cell
    std::uint32_t first;
    std::uint32_t count;
  };
  /// Calls visitor(Visited) for each node in depth-first order: parents first, then their own references, then octants in order. A visitor that returns
  /// false ends the visit.
  template <typename Visitor>
  void visit(const Visitor& visitor) const;
};

template <typename Visitor>
void Octree::visit(const Visitor& visitor) const {
  struct Pending {
    Box cell;
    std::uint32_t depth, number;
    std::uint32_t parent;
    bool is_leaf;
  };
  // Whether to go on.
  const auto show = [&](const Visited& visited) {
    if constexpr (std::is_same_v<decltype(visitor(visited)), bool>) return visitor(visited);
    visitor(visited);
    return true;
  };
  const auto show_leaf = [&](const Box& leaf_cell, std::uint32_t leaf_depth, std::uint32_t node, std::uint32_t leaf) {
    return show({leaf_cell, leaf_depth, node, true, leaf_first[leaf], leaf_first[leaf + 1] - leaf_first[leaf]});
  };
  if (nodes.empty()) return;
  std::vector<Pending> stack{{cell, 0, 0, 0, false}};
  while (!stack.empty()) {
    const Pending top = stack.back();
    stack.pop_back();
    if (top.is_leaf) {
      if (!show_leaf(top.cell, top.depth, top.parent, top.number)) return;
      continue;
    }
    const OctreeNode& node = nodes[top.number];
    if (!show({top.cell, top.depth, top.number, false, 0, 0})) return;
    if (node.has_own != 0 && !show_leaf(top.cell, top.depth, top.number, node.first_leaf)) return;
    for (std::uint32_t octant = 8; octant-- > 0;) {
      const bool is_interior = (node.interior_mask >> octant & 1U) != 0;
      if (!is_interior && (node.leaf_mask >> octant & 1U) == 0) continue;
      stack.push_back({node.octant_cell(top.cell, octant), top.depth + 1, is_interior ? node.child(octant) : node.leaf(octant), top.number,
                       !is_interior});
    }
  }
}

}  // namespace grove
