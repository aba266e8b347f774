#pragma once

// Changes a kd-tree in place: leaves get other references, subtrees are replaced. Keeps what that takes: for each node what it costs, the pairs of nodes that
// are free, and how many references are in leaves at all. References that a leaf no longer needs are left behind, and pairs are used again, until
// compacting pays; so an edit takes time in proportion to what it changes, and memory stays within 1.5 times what the tree needs.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "grove/accel/kd_tree.h"
#include "grove/build/kd_tree/kd_plane.h"
#include "grove/build/kd_tree/kd_tree_part.h"

namespace grove {

/// What is known of the subtree of a node.
struct KdNodeRecord {
  float cost = 0.0F;   ///< expected, times what its cell measures (KdCostContext::measure)
  float built = 0.0F;  ///< expected cost for a ray that meets the cell, when the subtree was built
  std::uint32_t references = 0;
  std::uint32_t changes = 0;  ///< references that have come or gone since the subtree was built
};

/// A stretch of KdTree::references.
struct KdSlots {
  std::uint32_t first, count;
};

/// The same tree must be handed to all functions, and no one else may change it in between.
class KdTreeEditor {
 public:
  /// Takes down a tree as it was built. O(nodes).
  void study(const KdTree& tree, const KdCostContext& costs);
  /// Measures costs anew after `bounds` has grown; what they were when built stays. O(nodes).
  void measure_again(const KdTree& tree, const KdCostContext& costs);

  /// Makes `node`, a leaf or the parent of two, a leaf with these references, which ascend.
  void make_leaf(KdTree& tree, std::uint32_t node, const Box4& cell, std::uint32_t depth, std::span<const std::uint32_t> ids);
  /// Puts a part in place of the subtree of `node`, and takes down its costs as built.
  void replace(KdTree& tree, std::uint32_t node, const Box4& cell, std::uint32_t depth, const KdTreePart& part);
  /// Sums up the record of an interior node after its children's have changed.
  void sum_up(const KdTree& tree, std::uint32_t node, const Box4& cell);

  void count_changes(std::uint32_t node, std::uint32_t count) { records_[node].changes += count; }

  [[nodiscard]] const KdNodeRecord& record(std::uint32_t node) const { return records_[node]; }
  [[nodiscard]] float cost_of_leaf(const Box4& cell, std::size_t count) const {
    return costs_.measure(cell) * static_cast<float>(costs_.model.intersection) * static_cast<float>(count);
  }
  /// References in leaves.
  [[nodiscard]] std::uint64_t reference_count() const { return reference_count_; }

  /// Sets the tree's depth, and puts all in depth-first order without gaps where too many are left behind. Returns whether it did that. O(1) or O(nodes +
  /// references), which is O(1) for each change.
  bool finish(KdTree& tree);
  /// The references that have changed since the last finish, which may name stretches that are no longer used.
  [[nodiscard]] std::span<const KdSlots> changed_slots() const { return changed_slots_; }
  void clear_changed_slots() { changed_slots_.clear(); }

 private:
  class Copy;
  enum class Takes : std::uint8_t { cost, cost_as_built };

  void measure(const KdTree& tree, std::uint32_t node, const Box4& cell, std::uint32_t depth, Takes takes);
  void release(KdTree& tree, std::uint32_t node, std::uint32_t depth);
  [[nodiscard]] std::uint32_t allocate_pair(KdTree& tree);
  void place(KdTree& tree, const KdTreePart& part, std::uint32_t node, const Box4& cell, std::uint32_t depth);
  void place_node(KdTree& tree, const KdTreePart& part, std::uint32_t from, std::uint32_t node, const Box4& cell, std::uint32_t depth);
  void place_leaf(KdTree& tree, std::uint32_t node, const Box4& cell, std::uint32_t depth, std::uint32_t first,
                  std::span<const std::uint32_t> ids);
  void set_built(std::uint32_t node, const Box4& cell);
  void compact(KdTree& tree);

  KdCostContext costs_{};
  std::vector<KdNodeRecord> records_;      // by node
  std::vector<std::uint32_t> free_pairs_;  // their lower nodes
  std::uint64_t reference_count_ = 0;
  std::array<std::uint64_t, KdTree::kMaxDepth + 1> leaves_at_{};  // by depth
  std::vector<KdSlots> changed_slots_;
};

}  // namespace grove
