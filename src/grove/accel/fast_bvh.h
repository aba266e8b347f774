#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "grove/base/huge_vector.h"
#include "grove/math/box.h"

namespace grove {

/// The step of addresses in a FastBvh: nodes and blocks of triangles begin at multiples of it.
struct alignas(32) FastUnit {
  std::byte bytes[32];
};

/// What a child of a FastNode is, in one word: a node or a block of triangles, and where it lies in the memory of the hierarchy. So a kernel finds
/// both by the same arithmetic.
class FastChild {
 public:
  FastChild() = default;

  [[nodiscard]] static FastChild node(std::uint32_t number) { return FastChild(number * kNodeUnits); }
  /// The block that begins at a unit.
  [[nodiscard]] static FastChild leaf(std::uint32_t unit) { return FastChild(kLeaf | unit); }

  [[nodiscard]] bool is_leaf() const { return (word_ & kLeaf) != 0; }
  /// The number of a node.
  [[nodiscard]] std::uint32_t node() const { return word_ / kNodeUnits; }
  [[nodiscard]] std::uint32_t unit() const { return word_ & (kMostUnits - 1); }

  static constexpr std::uint32_t kNodeUnits = 8;
  static constexpr std::uint32_t kMostUnits = std::uint32_t{1} << 30;
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

static_assert(sizeof(FastNode) == FastChild::kNodeUnits * sizeof(FastUnit));

/// Up to four different triangles by axis, corner and place; the same triangle may stand in other blocks. Unused places repeat the first, which
/// no query can tell: the same hit twice is one. 160 bytes.
struct alignas(32) TriangleBlock {
  static constexpr int kWidth = 4;
  static constexpr std::uint32_t kUnits = 5;

  float corners[3][3][kWidth];
  std::uint32_t primitive[kWidth];

  /// How many triangles there are, 1 to 4.
  [[nodiscard]] std::uint32_t count() const {
    std::uint32_t count = 1;
    for (int place = 1; place < kWidth; ++place) count += primitive[place] != primitive[0] ? 1 : 0;
    return count;
  }
};

static_assert(sizeof(TriangleBlock) == TriangleBlock::kUnits * sizeof(FastUnit));

/// The hierarchy of the fast path, as plain data: wide nodes over blocks of triangles, without a way back to the mesh. Node 0 is the root
/// and there whenever a triangle is; children have higher numbers than their parents. All nodes come before all blocks, which stand in the order of
/// the leaves.
class FastBvh {
 public:
  Box bounds;
  std::uint32_t depth = 0;       ///< edges from the root to the deepest leaf
  std::uint32_t references = 0;  ///< triangles in all blocks

  FastBvh() = default;
  /// Room for so many nodes and blocks, which are not initialised. Throws Error where there are more than FastChild::kMostUnits units.
  FastBvh(std::size_t node_count, std::size_t block_count);

  [[nodiscard]] bool empty() const { return node_count_ == 0; }
  [[nodiscard]] std::span<FastNode> nodes() { return {reinterpret_cast<FastNode*>(units_.data()), node_count_}; }
  [[nodiscard]] std::span<const FastNode> nodes() const { return {reinterpret_cast<const FastNode*>(units_.data()), node_count_}; }
  [[nodiscard]] std::span<TriangleBlock> blocks() {
    return {reinterpret_cast<TriangleBlock*>(units_.data() + first_block()), block_count_};
  }
  [[nodiscard]] std::span<const TriangleBlock> blocks() const {
    return {reinterpret_cast<const TriangleBlock*>(units_.data() + first_block()), block_count_};
  }
  [[nodiscard]] const TriangleBlock& block(FastChild leaf) const {
    return *reinterpret_cast<const TriangleBlock*>(units_.data() + leaf.unit());
  }
  /// The leaf that block number `block` is.
  [[nodiscard]] FastChild leaf(std::size_t block) const {
    return FastChild::leaf(static_cast<std::uint32_t>(first_block() + block * TriangleBlock::kUnits));
  }
  /// What the places of nodes and blocks are counted from.
  [[nodiscard]] const FastUnit* units() const { return units_.data(); }

  [[nodiscard]] std::size_t memory() const { return units_.size() * sizeof(FastUnit); }

  /// The first broken invariant in words, or an empty string: each child's box inside its parent's and its triangles inside it, each node and block
  /// reached once, orders permutations, ids below `primitive_count`, depth and references as found. O(nodes + references).
  [[nodiscard]] std::string validate(std::size_t primitive_count) const;

  /// Calls visit(box, depth, number, count) for each node and leaf in depth-first order, parents first; count is 0 for an interior node. The number
  /// of a leaf is the unit where its block begins.
  template <typename Visitor>
  void visit(const Visitor& visitor) const;

 private:
  [[nodiscard]] std::size_t first_block() const { return node_count_ * FastChild::kNodeUnits; }

  HugeVector<FastUnit> units_;
  std::size_t node_count_ = 0;
  std::size_t block_count_ = 0;
};

template <typename Visitor>
void FastBvh::visit(const Visitor& visitor) const {
  struct Pending {
    Box box;
    std::uint32_t depth;
    FastChild child;
  };
  if (empty()) return;
  std::vector<Pending> stack{{bounds, 0, FastChild::node(0)}};
  while (!stack.empty()) {
    const Pending top = stack.back();
    stack.pop_back();
    const bool is_leaf = top.child.is_leaf();
    visitor(top.box, top.depth, is_leaf ? top.child.unit() : top.child.node(), is_leaf ? block(top.child).count() : 0);
    if (is_leaf) continue;
    const FastNode& node = nodes()[top.child.node()];
    for (int i = FastNode::kWidth - 1; i >= 0; --i)
      if (node.has_child(i)) stack.push_back({node.child_box(i), top.depth + 1, node.child[i]});
  }
}

}  // namespace grove
