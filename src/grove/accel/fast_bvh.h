#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "grove/accel/fast_block.h"
#include "grove/accel/fast_child.h"
#include "grove/accel/fast_node.h"
#include "grove/base/huge_vector.h"
#include "grove/math/box.h"

namespace grove {

/// The hierarchy of the fast path, as plain data: wide nodes over blocks of triangles. Node 0 is the root
/// and there whenever a triangle is; children have higher numbers than their parents. All nodes come before all blocks, which stand in the order of
/// the leaves.
template <typename NodeFormat, typename BlockFormat>
class BasicFastBvh {
 public:
  using Node = NodeFormat;
  using Block = BlockFormat;
  using Child = typename Node::Child;

  Box bounds;
  std::uint32_t depth = 0;       ///< edges from the root to the deepest leaf
  std::uint32_t references = 0;  ///< triangles in all blocks

  BasicFastBvh() = default;
  /// Room for so many nodes and blocks, which are not initialised. Throws Error where there are more than Child::kMostUnits units.
  BasicFastBvh(std::size_t node_count, std::size_t block_count);

  [[nodiscard]] bool empty() const { return node_count_ == 0; }
  [[nodiscard]] std::span<Node> nodes() { return {reinterpret_cast<Node*>(units_.data()), node_count_}; }
  [[nodiscard]] std::span<const Node> nodes() const { return {reinterpret_cast<const Node*>(units_.data()), node_count_}; }
  [[nodiscard]] std::span<Block> blocks() { return {reinterpret_cast<Block*>(units_.data() + first_block()), block_count_}; }
  [[nodiscard]] std::span<const Block> blocks() const {
    return {reinterpret_cast<const Block*>(units_.data() + first_block()), block_count_};
  }
  [[nodiscard]] const Block& block(Child leaf) const { return *reinterpret_cast<const Block*>(units_.data() + leaf.unit()); }
  /// The leaf that block number `block` is.
  [[nodiscard]] Child leaf(std::size_t block) const {
    return Child::leaf(static_cast<std::uint32_t>(first_block() + block * Block::kUnits));
  }
  /// What the places of nodes and blocks are counted from.
  [[nodiscard]] const FastUnit* units() const { return units_.data(); }

  [[nodiscard]] std::size_t memory() const { return units_.size() * sizeof(FastUnit); }

  /// The first broken invariant in words, or an empty string: each child's box inside its parent's (as far as the format is exact) and its triangles inside it, each node and block
  /// reached once, orders permutations, ids below `primitive_count`, depth and references as found. O(nodes + references).
  /// `mesh_vertices` is what blocks count the corners of triangles in, where they do.
  [[nodiscard]] std::string validate(std::size_t primitive_count, std::span<const Vec3> mesh_vertices = {}) const;

  /// Calls visit(box, depth, number, count) for each node and leaf in depth-first order, parents first; count is 0 for an interior node. The number
  /// of a leaf is the unit where its block begins.
  template <typename Visitor>
  void visit(const Visitor& visitor) const;

 private:
  [[nodiscard]] std::size_t first_block() const { return node_count_ * Child::kNodeUnits; }

  HugeVector<FastUnit> units_;
  std::size_t node_count_ = 0;
  std::size_t block_count_ = 0;
};

/// Whole boxes and triangles, without a way back to the mesh.
using FastBvh = BasicFastBvh<FastNode, TriangleBlock>;
/// About half of the memory; needs the mesh's vertices where it is traced.
using CompressedFastBvh = BasicFastBvh<CompressedNode, IndexedBlock>;

extern template class BasicFastBvh<FastNode, TriangleBlock>;
extern template class BasicFastBvh<CompressedNode, IndexedBlock>;

template <typename NodeFormat, typename BlockFormat>
template <typename Visitor>
void BasicFastBvh<NodeFormat, BlockFormat>::visit(const Visitor& visitor) const {
  struct Pending {
    Box box;
    std::uint32_t depth;
    Child child;
  };
  if (empty()) return;
  std::vector<Pending> stack{{bounds, 0, Child::node(0)}};
  while (!stack.empty()) {
    const Pending top = stack.back();
    stack.pop_back();
    const bool is_leaf = top.child.is_leaf();
    visitor(top.box, top.depth, is_leaf ? top.child.unit() : top.child.node(), is_leaf ? block(top.child).count() : 0);
    if (is_leaf) continue;
    const Node& node = nodes()[top.child.node()];
    const EightBoxes boxes = node.boxes();
    for (int i = Node::kWidth - 1; i >= 0; --i)
      if (node.has_child(i)) stack.push_back({boxes.box(i).intersection(top.box), top.depth + 1, node.child[i]});
  }
}

}  // namespace grove
