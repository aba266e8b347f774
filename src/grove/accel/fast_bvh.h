#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "grove/base/huge_vector.h"
#include "grove/math/box.h"

namespace grove {

/// What a child of a FastNode is, in one word: a node by its number, or one block of triangles by its number and how many it holds.
class FastChild {
 public:
  FastChild() = default;

  [[nodiscard]] static FastChild node(std::uint32_t number) { return FastChild(number); }
  /// A block of 1 to 4 triangles.
  [[nodiscard]] static FastChild leaf(std::uint32_t block, std::uint32_t count) { return FastChild(kLeaf | block << 2 | (count - 1)); }

  [[nodiscard]] bool is_leaf() const { return (word_ & kLeaf) != 0; }
  [[nodiscard]] std::uint32_t node() const { return word_; }
  [[nodiscard]] std::uint32_t block() const { return (word_ & ~kLeaf) >> 2; }
  [[nodiscard]] std::uint32_t count() const { return (word_ & 3) + 1; }

  /// Of blocks, and of nodes.
  static constexpr std::uint32_t kMostBlocks = std::uint32_t{1} << 28;
  static constexpr std::uint32_t kLeaf = 0x80000000U;

 private:
  explicit FastChild(std::uint32_t word) : word_(word) {}

  std::uint32_t word_;
};

/// An interior node with up to eight children, in four cache lines.
///
///   bytes   0..191  planes[axis][0][i], planes[axis][1][i]: lower and upper bound of child i; unused places have an inverted infinite box,
///                   which no ray meets
///   bytes 192..223  child[i]
///   bytes 224..255  order[octant]: the places of the children from far to near for rays whose direction has negative components where the
///                   bits of `octant` are set (bit 0 for x), three bits each, the farthest in the lowest
struct alignas(64) FastNode {
  static constexpr int kWidth = 8;

  float planes[3][2][kWidth];
  FastChild child[kWidth];
  std::uint32_t order[kWidth];

  [[nodiscard]] Box child_box(int i) const {
    return {{planes[0][0][i], planes[1][0][i], planes[2][0][i]}, {planes[0][1][i], planes[1][1][i], planes[2][1][i]}};
  }
  [[nodiscard]] bool has_child(int i) const { return planes[0][0][i] <= planes[0][1][i]; }
};

static_assert(sizeof(FastNode) == 256);

/// Up to four triangles by axis, corner and place; the same triangle may stand in other blocks. Unused places hold zeros. 160 bytes.
struct alignas(32) TriangleBlock {
  static constexpr int kWidth = 4;

  float corners[3][3][kWidth];
  std::uint32_t primitive[kWidth];
};

static_assert(sizeof(TriangleBlock) == 160);

/// The hierarchy of the fast path, as plain data: wide nodes over blocks of triangles, without a way back to the mesh. Node 0 is the root
/// and there whenever a triangle is; children have higher numbers than their parents. Blocks stand in the order of the leaves.
struct FastBvh {
  HugeVector<FastNode> nodes;
  HugeVector<TriangleBlock> blocks;
  Box bounds;
  std::uint32_t depth = 0;       ///< edges from the root to the deepest leaf
  std::uint32_t references = 0;  ///< triangles in all blocks

  [[nodiscard]] std::size_t memory() const { return nodes.size() * sizeof(FastNode) + blocks.size() * sizeof(TriangleBlock); }

  /// The first broken invariant in words, or an empty string: each child's box inside its parent's and its triangles inside it, each node and block
  /// reached once, orders permutations, ids below `primitive_count`, depth and references as found. O(nodes + references).
  [[nodiscard]] std::string validate(std::size_t primitive_count) const;

  /// Calls visit(box, depth, block, count) for each node and leaf in depth-first order, parents first; count is 0 for an interior node.
  template <typename Visitor>
  void visit(const Visitor& visitor) const;
};

template <typename Visitor>
void FastBvh::visit(const Visitor& visitor) const {
  struct Pending {
    Box box;
    std::uint32_t depth;
    FastChild child;
  };
  if (nodes.empty()) return;
  std::vector<Pending> stack{{bounds, 0, FastChild::node(0)}};
  while (!stack.empty()) {
    const Pending top = stack.back();
    stack.pop_back();
    const bool is_leaf = top.child.is_leaf();
    visitor(top.box, top.depth, is_leaf ? top.child.block() : top.child.node(), is_leaf ? top.child.count() : 0);
    if (is_leaf) continue;
    const FastNode& node = nodes[top.child.node()];
    for (int i = FastNode::kWidth - 1; i >= 0; --i)
      if (node.has_child(i)) stack.push_back({node.child_box(i), top.depth + 1, node.child[i]});
  }
}

}  // namespace grove
