#pragma once

// Collapsing a binary hierarchy: which of its subtrees become leaves, and which of its nodes are opened so that their children become children
// of the node above. Both are decided together, to the least cost of equation 2 of the review generalised to several subsets: a node
// with the subsets A_k costs  t_node + sum over k of S_k / S times the cost of A_k,  a leaf  n t_intersection.
//
// - optimal: dynamic programming over the binary tree (Ylitie, Karras, Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed
//   Wide BVHs", 2017, section 3.1). For each subtree the least cost of replacing it by at most k subtrees, for all k.
// - greedy: the multi-way split from the top down. A set is split into as many subsets as a node may have children by splitting, again and again, the subset whose splitting
//   lowers the node's cost most. How a subset is split depends on the subset alone, so splitting sets from the top is the
//   same as opening nodes of the binary tree of all splits from the top, which is what is done here. A set stays whole where testing it costs
//   no more than its multi-way split.
//
// With an arity of 2 the optimal plan opens nothing and decides the leaves of a binary hierarchy.

#include <cstdint>
#include <span>
#include <vector>

#include "grove/accel/bvh2.h"
#include "grove/accel/wide_bvh.h"
#include "grove/build/passes/least_forests.h"

namespace grove {

/// What a binary hierarchy is to be collapsed to. Knows subtrees by the numbers of their root nodes.
class CollapsePlan {
 public:
  static constexpr int kMaxArity = CollapseSettings::kMaxArity;

  /// By the areas of the boxes. `bvh` must be in depth-first order and outlive the plan. O(nodes), parallel by subtrees.
  CollapsePlan(const Bvh2& bvh, const CollapseSettings& settings);
  /// The same by other areas: `slot_areas[2 i + side]` is the area of the volume around that child of node i, in any unit and for any convex volume.
  CollapsePlan(const Bvh2& bvh, std::span<const float> slot_areas, float root_area, const CollapseSettings& settings);

  /// A child of a planned node.
  struct Child {
    std::uint32_t slot;   ///< of the binary hierarchy: 2 * node + side
    std::uint32_t node;   ///< number of the binary node that roots it, or kNoNode
    std::uint32_t first;  ///< references, when it is a leaf
    std::uint32_t count;  ///< 0 for an interior node
  };
  static constexpr std::uint32_t kNoNode = 0xffffffffU;
  static constexpr std::uint32_t kRootSlot = 0xffffffffU;

  /// The root as a child of nothing.
  [[nodiscard]] Child root() const;
  /// The children of a planned interior node, in the order of the binary hierarchy; returns how many.
  int children(std::uint32_t node, Child* children) const;

 private:
  struct Range {
    std::uint32_t first, count;
  };

  void plan();
  LeastForests plan_range(std::uint32_t first, std::uint32_t last);
  LeastForests plan_small_range(std::uint32_t first, std::uint32_t last);
  void plan_node(std::uint32_t node, const LeastForests* left, const LeastForests* right, LeastForests& both);
  [[nodiscard]] LeastForests forests_of_leaf(std::uint32_t slot) const;
  [[nodiscard]] float slot_area(std::uint32_t slot) const;
  [[nodiscard]] float node_area(std::uint32_t node) const;
  void list_ranges();
  [[nodiscard]] Range range_of(std::uint32_t node) const;
  void collect(std::uint32_t slot, int roots, Child* children, int& count) const;
  [[nodiscard]] Child child_of(std::uint32_t slot) const;
  [[nodiscard]] bool is_leaf(std::uint32_t node) const;
  // The time of testing all references of a subset, by the chance that its volume is met.
  [[nodiscard]] float subset_cost(std::uint32_t slot) const;
  int open_greedily(std::uint32_t node, std::uint32_t* slots) const;

  const Bvh2& bvh_;
  std::span<const float> slot_areas_;
  CollapseSettings settings_;
  float area_scale_;
  HugeVector<ForestChoices> choices_;  // of each node
  // Areas of nodes, where they are not those of the boxes, and the references of each node, for the greedy plan.
  std::vector<float> areas_;
  std::vector<Range> ranges_;
};

/// Half areas of the boxes of all slots in scaled units, and of the root.
struct SlotAreas {
  std::vector<float> slots;
  float root = 0.0F;
};
[[nodiscard]] SlotAreas box_areas(const Bvh2& bvh);

/// The same hierarchy with the leaves that cost least. `bvh` must be in depth-first order. A leaf that would name a primitive twice (pieces of a
/// spatial split) names it once. O(nodes + references).
[[nodiscard]] Bvh2 collapse_leaves(const Bvh2& bvh, const CollapseSettings& settings);

/// The hierarchy with up to kWidth children a node (settings.arity is taken as kWidth). Otherwise as collapse_leaves.
template <int kWidth>
[[nodiscard]] WideBvh<kWidth> widen(const Bvh2& bvh, const CollapseSettings& settings);

}  // namespace grove
