#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "grove/base/huge_vector.h"
#include "grove/math/box.h"

namespace grove {

/// An interior node with up to kWidth children.
///
///   planes[axis][0][i], planes[axis][1][i]: lower and upper bound of child i; unused places have an inverted infinite box, which no ray meets
///   child[i]: `count` references from `first` on when it is a leaf; with a count of 0 the node number `first`
template <int kWidth>
struct alignas(64) WideNode {
  struct Child {
    std::uint32_t first;
    std::uint32_t count;

    [[nodiscard]] bool is_leaf() const { return count > 0; }
    /// The number of a node that is no leaf.
    [[nodiscard]] std::uint32_t node() const { return first; }
  };

  float planes[3][2][kWidth];
  Child child[kWidth];

  [[nodiscard]] Box child_box(int i) const {
    return {{planes[0][0][i], planes[1][0][i], planes[2][0][i]}, {planes[0][1][i], planes[1][1][i], planes[2][1][i]}};
  }
  void set_child(int i, const Box& box, Child link) {
    for (int axis = 0; axis < 3; ++axis) {
      planes[axis][0][i] = box.lower[axis];
      planes[axis][1][i] = box.upper[axis];
    }
    child[i] = link;
  }
  /// Whether place i is in use: places are filled from 0 on.
  [[nodiscard]] bool has_child(int i) const { return planes[0][0][i] <= planes[0][1][i]; }
};

static_assert(sizeof(WideNode<4>) == 128);
static_assert(sizeof(WideNode<8>) == 256);

/// A bounding volume hierarchy over axis-aligned boxes with up to kWidth children a node, as plain data. Node 0 is the root, children have higher
/// numbers than their parents; a hierarchy whose root is a leaf has no nodes. Knows boxes and primitive ids, no geometry.
template <int kWidth>
struct WideBvh {
  HugeVector<WideNode<kWidth>> nodes;
  HugeVector<std::uint32_t> references;  ///< primitive ids, leaf by leaf
  Box bounds;
  std::uint32_t depth = 0;  ///< edges from the root to the deepest leaf; at most Bvh2::kMaxDepth

  [[nodiscard]] std::size_t memory() const { return nodes.size() * sizeof(WideNode<kWidth>) + references.size() * sizeof(std::uint32_t); }

  /// The first broken invariant in words, or an empty string; as Bvh2::validate.
  [[nodiscard]] std::string validate(std::size_t primitive_count) const;

  /// Calls visit(box, depth, first, count) for each node and leaf in depth-first order, parents first; count is 0 for an interior node.
  template <typename Visitor>
  void visit(const Visitor& visitor) const;
};

template <int kWidth>
template <typename Visitor>
void WideBvh<kWidth>::visit(const Visitor& visitor) const {
  struct Pending {
    Box box;
    std::uint32_t depth, first, count;
  };
  if (references.empty()) return;
  std::vector<Pending> stack{{bounds, 0, 0, nodes.empty() ? static_cast<std::uint32_t>(references.size()) : 0}};
  while (!stack.empty()) {
    const Pending top = stack.back();
    stack.pop_back();
    visitor(top.box, top.depth, top.first, top.count);
    if (top.count > 0) continue;
    const WideNode<kWidth>& node = nodes[top.first];
    for (int i = kWidth - 1; i >= 0; --i)
      if (node.has_child(i)) stack.push_back({node.child_box(i), top.depth + 1, node.child[i].first, node.child[i].count});
  }
}

extern template struct WideBvh<4>;
extern template struct WideBvh<8>;

}  // namespace grove
