#include "grove/build/kd_tree/add_ropes.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "grove/base/parallel.h"
#include "grove/build/split.h"

namespace grove {
namespace {

// A node on the way down, with its cell and what is behind each face.
struct Cell {
  std::uint32_t node;
  std::uint32_t depth;
  Box box;
  std::uint32_t ropes[6];
};

class RopeMaker {
 public:
  RopeMaker(const KdTree& tree, KdRopes& ropes) : tree_(tree), ropes_(ropes) {}

  void make(Cell cell) const {
    const KdNode node = tree_.nodes[cell.node];
    if (node.is_leaf()) {
      KdRopedLeaf& leaf = ropes_.leaves[node.first()];
      leaf.cell = cell.box;
      for (int face = 0; face < 6; ++face) leaf.ropes[face] = push_down(cell.ropes[face], face, cell.box);
      return;
    }
    const int axis = static_cast<int>(node.axis());
    Cell lower = cell;
    Cell upper = cell;
    lower.node = node.lower_child();
    upper.node = lower.node + 1;
    lower.depth = upper.depth = cell.depth + 1;
    lower.box.upper[axis] = upper.box.lower[axis] = node.plane();
    lower.ropes[2 * axis + 1] = upper.node;
    upper.ropes[2 * axis] = lower.node;
    constexpr std::uint32_t kTaskDepth = 10;
    if (cell.depth < kTaskDepth) {
      parallel_invoke([&] { make(lower); }, [&] { make(upper); });
    } else {
      make(lower);
      make(upper);
    }
  }

 private:
  // The smallest node below `node` whose cell touches all of a face of `box`.
  [[nodiscard]] std::uint32_t push_down(std::uint32_t node, int face, const Box& box) const {
    if (node == KdRopedLeaf::kOutside) return node;
    for (;;) {
      const KdNode behind = tree_.nodes[node];
      if (behind.is_leaf()) return node;
      const int axis = static_cast<int>(behind.axis());
      if (axis == face / 2) {
        // The child at the face: below an upper face it is the lower one.
        node = behind.lower_child() + (face % 2 == 0 ? 1 : 0);
      } else if (behind.plane() >= box.upper[axis]) {
        node = behind.lower_child();
      } else if (behind.plane() <= box.lower[axis]) {
        node = behind.lower_child() + 1;
      } else {
        return node;
      }
    }
  }

  const KdTree& tree_;
  KdRopes& ropes_;
};

// Numbers the leaves in the order of nodes, and moves what they refer to.
void move_leaves(KdTree& tree, KdRopes& ropes) {
  const auto is_used_leaf = [&](std::size_t i) { return i != 1 && tree.nodes[i].is_leaf(); };
  std::vector<std::uint32_t> first_leaf((tree.nodes.size() + kBuildChunkSize - 1) / kBuildChunkSize);
  parallel_chunks(tree.nodes.size(), kBuildChunkSize, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) first_leaf[chunk] += is_used_leaf(i) ? 1 : 0;
  });
  std::uint32_t total = 0;
  for (std::uint32_t& first : first_leaf) total += std::exchange(first, total);
  ropes.leaves.resize(total);
  parallel_chunks(tree.nodes.size(), kBuildChunkSize, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    std::uint32_t number = first_leaf[chunk];
    for (std::size_t i = first; i < last; ++i) {
      if (!is_used_leaf(i)) continue;
      KdRopedLeaf& leaf = ropes.leaves[number];
      // A leaf that nothing refers to stays like that.
      leaf.cell = {};
      std::fill_n(leaf.ropes, 6, KdRopedLeaf::kOutside);
      leaf.first = tree.nodes[i].first();
      leaf.count = tree.nodes[i].count();
      leaf.unused[0] = leaf.unused[1] = 0;
      tree.nodes[i] = KdNode::leaf(number, tree.nodes[i].count());
      ++number;
    }
  });
}

}  // namespace

void remove_ropes(KdTree& tree, const KdRopes& ropes) {
  parallel_for(tree.nodes.size(), kBuildChunkSize, [&](std::size_t i) {
    KdNode& node = tree.nodes[i];
    if (i != 1 && node.is_leaf()) node = KdNode::leaf(ropes.leaves[node.first()].first, node.count());
  });
}

KdRopes add_ropes(KdTree& tree) {
  KdRopes ropes;
  if (tree.nodes.empty()) return ropes;
  move_leaves(tree, ropes);
  constexpr std::uint32_t kNone = KdRopedLeaf::kOutside;
  RopeMaker(tree, ropes).make({0, 0, tree.bounds, {kNone, kNone, kNone, kNone, kNone, kNone}});
  return ropes;
}

}  // namespace grove
