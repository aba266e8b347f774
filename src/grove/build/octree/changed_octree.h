#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "grove/accel/octree.h"

namespace grove {

/// An octree without some of its primitives, as a view: what an update starts from. References of a subtree are in a row, so how many are left is known for each
/// node without going down, and subtrees that lost nothing need not be looked into.
class ChangedOctree {
 public:
  /// Primitives for which `is_removed` is true are out; it must know all that the tree names, and outlive this, as the tree must. In parallel in the caller's
  /// oneTBB arena. O(references).
  ChangedOctree(const Octree& tree, const std::vector<bool>& is_removed, std::uint32_t largest_leaf);

  [[nodiscard]] const Octree& tree() const { return tree_; }
  [[nodiscard]] const OctreeNode& node(std::uint32_t number) const { return tree_.nodes[number]; }

  /// Whether the node, with all below it, lost nothing.
  [[nodiscard]] bool is_kept(std::uint32_t number) const {
    const Octree::Below below = tree_.below(number);
    return removed(below.first_leaf, below.end_leaf) == 0;
  }
  [[nodiscard]] bool is_leaf_kept(std::uint32_t leaf) const { return removed(leaf, leaf + 1) == 0; }

  /// How many references are left in a node and below it.
  [[nodiscard]] std::size_t reference_count(std::uint32_t number) const {
    const Octree::Below below = tree_.below(number);
    return tree_.leaf_first[below.end_leaf] - tree_.leaf_first[below.first_leaf] - removed(below.first_leaf, below.end_leaf);
  }
  /// How many primitives are left, exactly where a leaf can hold them all; else the number of references. Nodes that lost nothing have more than a leaf can hold.
  [[nodiscard]] std::size_t primitive_count(std::uint32_t number) const;

  /// Appends what is left in a leaf.
  void append_leaf(std::uint32_t leaf, std::vector<std::uint32_t>& ids) const { append(leaf, leaf + 1, ids); }
  /// Appends what is left in a node and below it, repeats too.
  void append_all(std::uint32_t number, std::vector<std::uint32_t>& ids) const {
    const Octree::Below below = tree_.below(number);
    append(below.first_leaf, below.end_leaf, ids);
  }

 private:
  [[nodiscard]] std::size_t removed(std::uint32_t first_leaf, std::uint32_t end_leaf) const {
    return removed_before_[end_leaf] - removed_before_[first_leaf];
  }
  void append(std::uint32_t first_leaf, std::uint32_t end_leaf, std::vector<std::uint32_t>& ids) const;

  const Octree& tree_;
  const std::vector<bool>& is_removed_;
  std::uint32_t largest_leaf_;
  std::vector<std::uint32_t> removed_before_;  // references of leaves before this one
};

}  // namespace grove
