#include "grove/build/octree/thaw_octree.h"

#include <algorithm>
#include <span>
#include <utility>

#include "grove/base/parallel.h"

namespace grove {
namespace {

class Thaw {
 public:
  Thaw(const Octree& tree, const std::vector<bool>& is_removed, std::uint32_t largest_leaf)
      : tree_(tree), is_removed_(is_removed), largest_leaf_(largest_leaf) {}

  // The octants of the root are parts, by different threads.
  [[nodiscard]] OctreeDraft root() const {
    OctreeDraft draft;
    const OctreeNode& node = tree_.nodes[0];
    if (node.cut_axes == 0) {
      // Never cut: a leaf.
      std::vector<std::uint32_t> left;
      const bool is_kept = filter(node.first_leaf, left);
      if (left.empty()) return draft;
      draft.root = draft.add_leaf(left);
      draft.leaves.back().is_kept = is_kept;
      return draft;
    }
    std::vector<std::uint32_t> octants;
    for (std::uint32_t octant = 0; octant < 8; ++octant)
      if ((node.interior_mask >> octant & 1U) != 0) octants.push_back(octant);
    draft.parts.resize(octants.size());
    parallel_for(octants.size(), 1, [&](std::size_t i) {
      draft.parts[i] = std::make_unique<OctreeDraft>();
      draft.parts[i]->root = thaw_node(*draft.parts[i], node.child(octants[i]));
    });
    draft.root = thaw_node(draft, 0);
    return draft;
  }

 private:
  [[nodiscard]] std::span<const std::uint32_t> ids_of(std::uint32_t leaf) const {
    return {tree_.references.data() + tree_.leaf_first[leaf], tree_.leaf_first[leaf + 1] - tree_.leaf_first[leaf]};
  }

  // Of a leaf what is left.
  [[nodiscard]] bool filter(std::uint32_t leaf, std::vector<std::uint32_t>& left) const {
    left.clear();
    const std::span<const std::uint32_t> ids = ids_of(leaf);
    std::copy_if(ids.begin(), ids.end(), std::back_inserter(left), [&](std::uint32_t id) { return !is_removed_[id]; });
    return left.size() == ids.size();
  }

  [[nodiscard]] DraftSlot thaw_node(OctreeDraft& draft, std::uint32_t number) const {
    const OctreeNode& node = tree_.nodes[number];
    std::vector<std::uint32_t> left;
    bool is_kept = node.has_own == 0 || filter(node.first_leaf, left);
    const OctreeDraft::Mark before = draft.mark();
    const DraftSlot slot = draft.add_node({node.planes[0], node.planes[1], node.planes[2]}, node.cut_axes, 0, left);
    std::size_t count = left.size();
    bool is_empty = left.empty();
    std::size_t part = 0;
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
      DraftSlot below;
      if ((node.interior_mask >> octant & 1U) != 0) {
        // Those of the root are there already.
        below = number == 0 ? DraftSlot::part(part++) : thaw_node(draft, node.child(octant));
        const auto [child_draft, child] = draft.resolve(below);
        if (child.kind() == DraftSlot::Kind::empty) {
          is_kept = false;
          continue;
        }
        is_kept = is_kept && child_draft->nodes[child.number()].is_kept;
        count += child_draft->nodes[child.number()].count;
      } else if ((node.leaf_mask >> octant & 1U) != 0) {
        const bool is_leaf_kept = filter(node.leaf(octant), left);
        is_kept = is_kept && is_leaf_kept;
        if (left.empty()) continue;
        below = draft.add_leaf(left);
        draft.leaves.back().is_kept = is_leaf_kept;
        count += left.size();
      } else {
        continue;
      }
      is_empty = false;
      draft.nodes[slot.number()].octants[octant] = below;
    }
    if (is_empty) {
      draft.take_back(before);
      return {};
    }
    DraftNode& thawed = draft.nodes[slot.number()];
    thawed.is_kept = is_kept;
    // A node that lost nothing has more than a leaf may have.
    const std::size_t distinct = is_kept ? largest_leaf_ + 1 : distinct_ids(draft, slot);
    thawed.count = static_cast<std::uint32_t>(distinct <= largest_leaf_ ? distinct : std::max(count, distinct));
    return slot;
  }

  // How many primitives there are below, counted no farther than one more than a leaf may have.
  [[nodiscard]] std::size_t distinct_ids(const OctreeDraft& draft, DraftSlot slot) const {
    std::vector<std::uint32_t> found;
    std::vector<OctreeDraft::Place> pending{{&draft, slot}};
    const auto add = [&](std::span<const std::uint32_t> ids) {
      for (const std::uint32_t id : ids)
        if (found.size() <= largest_leaf_ && std::find(found.begin(), found.end(), id) == found.end()) found.push_back(id);
    };
    while (!pending.empty() && found.size() <= largest_leaf_) {
      const auto [here, top] = pending.back();
      pending.pop_back();
      if (top.kind() == DraftSlot::Kind::leaf) add(here->ids_of_leaf(top));
      if (top.kind() != DraftSlot::Kind::node) continue;
      add(here->ids_of(here->nodes[top.number()].own));
      for (const DraftSlot octant : here->nodes[top.number()].octants)
        if (octant.kind() != DraftSlot::Kind::empty) pending.push_back(here->resolve(octant));
    }
    return found.size();
  }

  const Octree& tree_;
  const std::vector<bool>& is_removed_;
  std::uint32_t largest_leaf_;
};

}  // namespace

OctreeDraft thaw_octree(const Octree& tree, const std::vector<bool>& is_removed, std::uint32_t largest_leaf) {
  return tree.nodes.empty() ? OctreeDraft() : Thaw(tree, is_removed, largest_leaf).root();
}

}  // namespace grove
