#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "grove/base/huge_vector.h"
#include "grove/math/box.h"

namespace grove {

/// An interior node of a binary hierarchy: the boxes of both children, so that one cache line decides where a ray goes next.
///
///   bytes  0..47  planes[axis] = { lower of child 0, lower of child 1, upper of child 0, upper of child 1 }
///   bytes 48..63  child[0], child[1]
struct alignas(64) Bvh2Node {
  /// What a child is: `count` references from `first` on when it is a leaf; with a count of 0 the node number `first`.
  struct Child {
    std::uint32_t first;
    std::uint32_t count;
  };

  float planes[3][4];
  Child child[2];

  [[nodiscard]] Box child_box(int index) const {
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
      box.lower[axis] = planes[axis][index];
      box.upper[axis] = planes[axis][index + 2];
    }
    return box;
  }
};

static_assert(sizeof(Bvh2Node) == 64);

/// A binary bounding volume hierarchy over axis-aligned boxes, as plain data.
///
/// Node 0 is the root. Builders leave the nodes in depth-first order, which the passes that say so rely on; rotations do not keep it. A
/// hierarchy whose root is a leaf has no nodes; `references` then holds that leaf. Knows boxes and primitive ids, no geometry.
struct Bvh2 {
  /// Builders never go deeper, so traversals keep their stack in an array of this size.
  static constexpr std::uint32_t kMaxDepth = 96;

  HugeVector<Bvh2Node> nodes;
  HugeVector<std::uint32_t> references;  ///< primitive ids, leaf by leaf
  Box bounds;                            ///< empty when there are no references
  std::uint32_t depth = 0;               ///< edges from the root to the deepest leaf

  /// Bytes kept for tracing.
  [[nodiscard]] std::size_t memory() const { return nodes.size() * sizeof(Bvh2Node) + references.size() * sizeof(std::uint32_t); }

  /// The first broken invariant in words, or an empty string: each child's box inside its parent's, each reference in exactly one leaf
  /// and below `primitive_count`, each node reached once, `depth` as found. O(nodes + references).
  [[nodiscard]] std::string validate(std::size_t primitive_count) const;

  /// Calls visit(box, depth, first, count) for each node and leaf in depth-first order, parents first; count is 0 for an interior node.
  template <typename Visitor>
  void visit(const Visitor& visitor) const;
};

template <typename Visitor>
void Bvh2::visit(const Visitor& visitor) const {
  struct Pending {
    Box box;
    std::uint32_t depth, first, count;
  };
  if (references.empty()) return;
  const bool root_is_leaf = nodes.empty();
  std::vector<Pending> stack{{bounds, 0, 0, root_is_leaf ? static_cast<std::uint32_t>(references.size()) : 0}};
  while (!stack.empty()) {
    const Pending top = stack.back();
    stack.pop_back();
    visitor(top.box, top.depth, top.first, top.count);
    if (top.count > 0) continue;
    const Bvh2Node& node = nodes[top.first];
    for (int child = 1; child >= 0; --child)
      stack.push_back({node.child_box(child), top.depth + 1, node.child[child].first, node.child[child].count});
  }
}

}  // namespace grove
