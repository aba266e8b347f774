#pragma once

// A kd-tree that follows primitives that come, go and move, without being built anew: references are taken out of the leaves that the old boxes reached and put
// into those that the new primitives reach. A leaf that gets more is parted where that lowers the expected cost, by what builds trees; two leaves that
// are cheaper as one become one; and subtrees that have become so much dearer that the expected rays pay for it are built anew. The review (section III.B) calls
// kd-trees hard and costly to update; docs/kdtree.md tells what that comes to.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "grove/build/kd_tree/build_kd_tree.h"
#include "grove/build/kd_tree/kd_edit_trail.h"
#include "grove/build/kd_tree/kd_tree_editor.h"

namespace grove {

/// When subtrees are built anew: where rays * chance of meeting the subtree * what building saves a ray in it > steps_per_reference * references.
struct KdRebuildRule {
  /// How many rays will be traced before the next update; 0: never.
  double rays = 1e6;
  /// What building takes for each reference, in steps of a traversal; measured, see docs/kdtree.md.
  double steps_per_reference = 80.0;
  /// By how much of itself cost grows against that of a subtree built anew when each reference has moved once; measured, see docs/kdtree.md. What
  /// building saves is expected to be as much, and no more than cost has grown.
  double cost_of_change = 0.15;
  /// Smaller subtrees are left as they are: their leaves follow by themselves.
  std::uint32_t least_references = 256;
};

struct KdTreeUpdate {
  /// Whether the tree must be built anew, by build_kd_tree: it would be too large, or nothing is left in it, or that is worth it. It is not to be traced.
  bool must_rebuild = false;
  double cost = 0.0;  ///< expected cost of the tree now
  std::uint64_t rebuilt_references = 0;
  bool is_compacted = false;       ///< all references may have changed their places
  std::span<const KdSlots> slots;  ///< else those that have changed; until the next update
};

/// Follows the primitives of one tree. Keeps their boxes and 16 bytes a node, once there has been an update.
class KdTreeUpdater {
 public:
  explicit KdTreeUpdater(const KdTreeSettings& settings) : settings_(settings) {}

  /// To be called when the tree was built by other means.
  void forget() { is_known_ = false; }
  /// Whether the tree has been updated since it was built. The first update takes O(n), later ones O(changed * depth) or less.
  [[nodiscard]] bool is_known() const { return is_known_; }
  /// Expected cost when all of the tree was last built. 0 where nothing is known.
  [[nodiscard]] double built_cost() const { return is_known_ ? built_cost_ : 0.0; }

  /// Makes a tree over `geometry` follow: primitives that are named in `changed` (in any order, repeats allowed) have come, gone or moved since it was built
  /// or last updated; others have not. The tree is one that build_kd_tree may give: it stays valid, no deeper and no larger than that allows; but for its
  /// bounds, which never shrink. In parallel in the caller's oneTBB arena; the same for any number of threads.
  template <Geometry G>
  KdTreeUpdate update(KdTree& tree, const G& geometry, std::span<const std::uint32_t> changed, const KdRebuildRule& rule) {
    const bool were_known = is_known_ && !tree.nodes.empty();
    if (!were_known) {
      boxes_.resize(geometry.size());
      parallel_for(boxes_.size(), 16384, [&](std::size_t i) { boxes_[i] = geometry.bounds(i); });
    }
    boxes_.resize(geometry.size());
    std::vector<Box> boxes(changed.size());
    parallel_for(changed.size(), 4096, [&](std::size_t i) { boxes[i] = geometry.bounds(changed[i]); });
    if (settings_.clip) return follow(tree, GeometryClipper<G>(geometry), changed, boxes, rule, were_known);
    return follow(tree, NoClipper(), changed, boxes, rule, were_known);
  }

 private:
  class Update;

  KdTreeUpdate follow(KdTree& tree, const ReferenceClipper& clipper, std::span<const std::uint32_t> changed, std::span<const Box> boxes,
                      const KdRebuildRule& rule, bool were_known);

  // Whether looking into all leaves for those that leave takes less than following their old boxes.
  [[nodiscard]] bool is_search_cheaper(const KdTree& tree, std::span<const std::uint32_t> leaving) const;

  KdTreeSettings settings_;
  bool is_known_ = false;
  double built_cost_ = 0.0;
  Box built_bounds_;
  std::size_t hittable_ = 0;              // boxes that are not empty
  std::vector<Box> boxes_;                // by primitive, as the tree knows them
  std::vector<std::uint8_t> is_changed_;  // by primitive; all 0 between updates
  KdTreeEditor editor_;
};

}  // namespace grove
