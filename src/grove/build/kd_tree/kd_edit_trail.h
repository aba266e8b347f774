#pragma once

// Which leaves of a kd-tree change when primitives come, go or move, found by going down the tree with all of them at once: those that arrive are parted by
// each plane as when building, clipped where they reach across, so that leaves get what builders would give them; those that leave are followed to all leaves
// that their old boxes touch. The tree is not changed.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "grove/accel/kd_tree.h"
#include "grove/build/kd_tree/part_references.h"
#include "grove/build/kd_tree/reference_clipper.h"

namespace grove {

/// A node whose subtree changes.
struct KdTrailStep {
  Box4 cell;
  std::uint32_t node;
  std::uint32_t depth;
  std::uint32_t first;     ///< the first step of its subtree, which are all from there to this one
  std::uint32_t first_id;  ///< leaves: in KdEditTrail::ids, up to first_id + id_count
  std::uint32_t id_count;
  std::uint32_t changes;  ///< references that come and go in the subtree
  bool is_leaf;
};

/// The changes that lie before a tree.
struct KdEditTrail {
  std::vector<KdTrailStep> steps;  ///< leaves, and the nodes above them, children before parents and lower before upper
  std::vector<std::uint32_t> ids;  ///< what leaves will refer to, ascending within one
  std::int64_t added = 0;          ///< references more than there are now
};

/// What changes.
struct KdChanges {
  References arriving;
  std::vector<std::uint32_t> leaving;  ///< primitives, of which `old_boxes` tells where they are
  std::span<const Box> old_boxes;
  /// Whether to look for those that leave in every leaf rather than by their boxes: where these are not known, or there are many.
  bool search_all = false;
  std::span<const std::uint8_t> is_changed;  ///< by primitive: whether leaves are to forget it, unless it arrives there
};

/// Follows changes through a tree, in parallel; the same for any number of threads. O(what changes * depth), and O(nodes) with search_all. Gives up, with
/// no trail, where there would be more than `most_added` references more.
[[nodiscard]] std::optional<KdEditTrail> follow_changes(const KdTree& tree, const KdChanges& changes, const ReferenceClipper& clipper,
                                                        std::int64_t most_added);

}  // namespace grove
