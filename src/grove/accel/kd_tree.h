#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "grove/base/huge_vector.h"
#include "grove/math/box.h"

namespace grove {

/// A node of a kd-tree.
///
///   bytes 0..3  interior: where the plane is, a float;         leaf: the first of its references
///   bytes 4..7  interior: number of the lower child * 4 + axis; leaf: how many references * 4 + 3
///
/// The upper child follows the lower one, so one cache line holds both and a ray picks the nearer by adding the sign of its direction.
class KdNode {
 public:
  KdNode() = default;
  [[nodiscard]] static KdNode interior(int axis, float plane, std::uint32_t lower_child) {
    return {std::bit_cast<std::uint32_t>(plane), lower_child << 2U | static_cast<std::uint32_t>(axis)};
  }
  [[nodiscard]] static KdNode leaf(std::uint32_t first, std::uint32_t count) { return {first, count << 2U | kLeafTag}; }

  [[nodiscard]] bool is_leaf() const { return (tagged_ & kLeafTag) == kLeafTag; }
  /// Interior nodes: 0, 1 or 2.
  [[nodiscard]] std::uint32_t axis() const { return tagged_ & kLeafTag; }
  [[nodiscard]] float plane() const { return std::bit_cast<float>(plane_or_first_); }
  [[nodiscard]] std::uint32_t lower_child() const { return tagged_ >> 2U; }
  /// Leaves.
  [[nodiscard]] std::uint32_t first() const { return plane_or_first_; }
  [[nodiscard]] std::uint32_t count() const { return tagged_ >> 2U; }

  friend bool operator==(const KdNode&, const KdNode&) = default;

 private:
  static constexpr std::uint32_t kLeafTag = 3;
  KdNode(std::uint32_t plane_or_first, std::uint32_t tagged) : plane_or_first_(plane_or_first), tagged_(tagged) {}

  std::uint32_t plane_or_first_;
  std::uint32_t tagged_;
};

static_assert(sizeof(KdNode) == 8);

/// A kd-tree, as plain data: planes that halve a box again and again until few primitives reach into a cell.
///
/// Node 0 is the root, node 1 is not used, and each further two are siblings, which so share a cache line. Cells are closed: a plane belongs to both
/// sides. A primitive is referenced in as many leaves as it takes for each of its points inside `bounds` to lie in the cell of one of them. An empty tree
/// has no nodes. As built, pairs and the references of leaves are in depth-first order without gaps; local updates (build/kd_tree/update_kd_tree.h) leave
/// pairs and references that nothing refers to. Knows boxes and primitive ids, no geometry.
struct KdTree {
  /// Builders never go deeper, so traversals keep their stack in an array of this size.
  static constexpr std::uint32_t kMaxDepth = 64;
  /// Numbers of nodes and references of a leaf are kept in 30 bits.
  static constexpr std::uint32_t kMaxNodes = (1U << 30U) - 2;

  HugeVector<KdNode> nodes;
  HugeVector<std::uint32_t> references;  ///< primitive ids; those of a leaf together and ascending
  Box bounds;                            ///< the cell of the root, which encloses all primitives; empty when there are no references
  std::uint32_t depth = 0;               ///< edges from the root to the deepest leaf

  /// Bytes kept for tracing.
  [[nodiscard]] std::size_t memory() const { return nodes.size() * sizeof(KdNode) + references.size() * sizeof(std::uint32_t); }

  /// The first broken invariant in words, or an empty string: each plane inside its cell, no pair reached twice, pairs that are not reached empty leaves,
  /// no reference in two leaves, ids ascending within a leaf and below `primitive_count`, `depth` as found. O(nodes + references).
  [[nodiscard]] std::string validate(std::size_t primitive_count) const;
  /// Whether all is in depth-first order without gaps. O(nodes).
  [[nodiscard]] bool is_compact() const;

  /// Calls visit(cell, depth, node) for each node in depth-first order, parents first, lower before upper.
  template <typename Visitor>
  void visit(const Visitor& visitor) const;
};

template <typename Visitor>
void KdTree::visit(const Visitor& visitor) const {
  struct Pending {
    Box cell;
    std::uint32_t depth, node;
  };
  if (nodes.empty()) return;
  std::vector<Pending> stack{{bounds, 0, 0}};
  while (!stack.empty()) {
    const Pending top = stack.back();
    stack.pop_back();
    const KdNode node = nodes[top.node];
    visitor(top.cell, top.depth, node);
    if (node.is_leaf()) continue;
    Pending lower{top.cell, top.depth + 1, node.lower_child()};
    Pending upper{top.cell, top.depth + 1, node.lower_child() + 1};
    lower.cell.upper[static_cast<int>(node.axis())] = node.plane();
    upper.cell.lower[static_cast<int>(node.axis())] = node.plane();
    stack.push_back(upper);
    stack.push_back(lower);
  }
}

}  // namespace grove
