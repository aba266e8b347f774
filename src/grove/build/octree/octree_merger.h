#pragma once

// Merges octrees over the same cell into one (section IV.A of the review: subsets of the primitives build local octrees, which are merged into a global one).
//
// The result is the octree that building from all primitives at once gives, bit for bit. That holds because the planes of a cell do not depend on what is in
// it, and whether a cell is cut depends on numbers alone: how many primitives it has, and how many its octants would have, which are sums over the local trees.
// Where a local tree has cut a cell that the whole one does not, its leaves are gathered again; where it has not, its leaf is parted now.

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "grove/base/parallel.h"
#include "grove/build/octree/octree_builder.h"

namespace grove {

/// One of several things that fill a cell together: a subtree, or a set that no tree has parted yet.
struct OctreeItem {
  OctreeDraft::Place place{nullptr, DraftSlot()};
  std::vector<std::uint32_t> loose;  ///< ascending; where there is no subtree

  [[nodiscard]] static OctreeItem subtree(OctreeDraft::Place place) { return {place, {}}; }
  [[nodiscard]] static OctreeItem set(std::span<const std::uint32_t> ids) { return {{nullptr, DraftSlot()}, {ids.begin(), ids.end()}}; }

  [[nodiscard]] bool is_node() const { return place.slot.kind() == DraftSlot::Kind::node; }
  /// Of a subtree that is a node.
  [[nodiscard]] const DraftNode& node() const { return place.draft->nodes[place.slot.number()]; }
  /// Of all others.
  [[nodiscard]] std::span<const std::uint32_t> ids() const {
    return place.slot.kind() == DraftSlot::Kind::leaf ? place.draft->ids_of_leaf(place.slot) : std::span<const std::uint32_t>(loose);
  }
  [[nodiscard]] std::size_t count() const { return is_node() ? node().count : ids().size(); }
  /// Whether it comes from an octree that is being updated, and nothing in it has changed.
  [[nodiscard]] bool is_kept() const {
    if (is_node()) return node().is_kept;
    return place.slot.kind() == DraftSlot::Kind::leaf && place.draft->leaves[place.slot.number()].is_kept;
  }
};

/// No primitive may be in two items, and nodes of the same cell must have the same planes.
template <OctreePlanes P>
class OctreeMerger {
 public:
  explicit OctreeMerger(const OctreeBuilder<P>& builder) : builder_(builder) {}

  /// In parallel in the caller's oneTBB arena; the same for any number of threads. O(nodes and references).
  [[nodiscard]] OctreeDraft merge(const std::vector<OctreeItem>& items, const OctreeCell& cell) const {
    Task task(builder_);
    task.draft.root = merge(items, cell, task);
    return std::move(task.draft);
  }

 private:
  struct Task {
    OctreeDraft draft;
    typename OctreeBuilder<P>::Subtree subtree;
    explicit Task(const OctreeBuilder<P>& builder) : subtree(builder, draft) {}
  };

  // What the items have in each octant, and of their own.
  struct Parted {
    std::vector<OctreeItem> octants[8];
    std::uint64_t counts[8] = {};
    std::uint64_t total = 0;
    std::vector<std::uint32_t> own;

    void add(std::uint32_t octant, OctreeItem item) {
      counts[octant] += item.count();
      total += item.count();
      octants[octant].push_back(std::move(item));
    }
  };

  DraftSlot merge(const std::vector<OctreeItem>& items, const OctreeCell& cell, Task& task) const {
    if (items.empty()) return {};
    if (items.size() == 1 && items[0].is_kept()) return copy(items[0].place, task.draft);
    std::size_t count = 0;
    const DraftNode* cut_by = nullptr;
    for (const OctreeItem& item : items) {
      count += item.count();
      if (item.is_node()) cut_by = &item.node();
    }
    if (cut_by == nullptr && count <= kOctreeTaskSize) return task.subtree.build(gather(items), cell);
    if (cut_by == nullptr) {
      task.draft.parts.push_back(std::make_unique<OctreeDraft>(builder_.build(gather(items), cell)));
      return DraftSlot::part(task.draft.parts.size() - 1);
    }
    if (builder_.is_small(count, cell)) return task.draft.add_leaf(gather(items));
    const OctantCut cut{cell.box, to_float4(cut_by->planes), cut_by->cut_axes};
    const Parted parted = part(items, cut);
    if (parted.total > cell.capacity) return task.draft.add_leaf(gather(items));

    const DraftSlot slot = task.draft.add_node(cut_by->planes, cut_by->cut_axes, count, parted.own);
    std::vector<std::uint32_t> octants;
    for (std::uint32_t octant = 0; octant < 8; ++octant)
      if (parted.counts[octant] > 0) octants.push_back(octant);
    const auto child = [&](std::uint32_t octant) { return cell.octant(cut, octant, parted.counts[octant], parted.total, cell.bad_cuts); };
    if (count <= kOctreeTaskSize) {
      for (const std::uint32_t octant : octants) {
        const DraftSlot below = merge(parted.octants[octant], child(octant), task);
        task.draft.nodes[slot.number()].octants[octant] = below;
      }
      return slot;
    }
    const std::size_t first_part = task.draft.parts.size();
    task.draft.parts.resize(first_part + octants.size());
    for (std::size_t i = 0; i < octants.size(); ++i) task.draft.nodes[slot.number()].octants[octants[i]] = DraftSlot::part(first_part + i);
    parallel_for(octants.size(), 1, [&](std::size_t i) {
      task.draft.parts[first_part + i] = std::make_unique<OctreeDraft>(merge(parted.octants[octants[i]], child(octants[i])));
    });
    return slot;
  }

  // A subtree as it is.
  static DraftSlot copy(const OctreeDraft::Place& place, OctreeDraft& draft) {
    if (place.slot.kind() == DraftSlot::Kind::leaf) return draft.add_leaf(place.draft->ids_of_leaf(place.slot));
    const DraftNode& node = place.draft->nodes[place.slot.number()];
    const DraftSlot slot = draft.add_node(node.planes, node.cut_axes, node.count, place.draft->ids_of(node.own));
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
      if (node.octants[octant].kind() == DraftSlot::Kind::empty) continue;
      const DraftSlot below = copy(place.draft->resolve(node.octants[octant]), draft);
      draft.nodes[slot.number()].octants[octant] = below;
    }
    return slot;
  }

  Parted part(const std::vector<OctreeItem>& items, const OctantCut& cut) const {
    Parted parted;
    OctantSets sets;
    const auto keep = [&](std::span<const std::uint32_t> own) { parted.own.insert(parted.own.end(), own.begin(), own.end()); };
    for (const OctreeItem& item : items) {
      if (item.is_node()) {
        for (std::uint32_t octant = 0; octant < 8; ++octant) {
          const OctreeDraft::Place place = item.place.draft->resolve(item.node().octants[octant]);
          if (place.slot.kind() != DraftSlot::Kind::empty) parted.add(octant, OctreeItem::subtree(place));
        }
        keep(item.place.draft->ids_of(item.node().own));
        continue;
      }
      sets.part(builder_.source(), cut, item.ids(), builder_.settings().store);
      for (std::uint32_t octant = 0; octant < 8; ++octant)
        if (sets.count(octant) > 0) parted.add(octant, OctreeItem::set(sets.of(octant)));
      keep(sets.own());
    }
    std::sort(parted.own.begin(), parted.own.end());
    return parted;
  }

  // All primitives of the items, each once.
  static std::vector<std::uint32_t> gather(const std::vector<OctreeItem>& items) {
    std::vector<std::uint32_t> ids;
    std::vector<OctreeDraft::Place> pending;
    for (const OctreeItem& item : items) {
      if (!item.is_node()) ids.insert(ids.end(), item.ids().begin(), item.ids().end());
      if (item.is_node()) pending.push_back(item.place);
    }
    while (!pending.empty()) {
      const auto [draft, slot] = pending.back();
      pending.pop_back();
      const bool is_node = slot.kind() == DraftSlot::Kind::node;
      const std::span<const std::uint32_t> here = is_node ? draft->ids_of(draft->nodes[slot.number()].own) : draft->ids_of_leaf(slot);
      ids.insert(ids.end(), here.begin(), here.end());
      if (!is_node) continue;
      for (const DraftSlot octant : draft->nodes[slot.number()].octants)
        if (octant.kind() != DraftSlot::Kind::empty) pending.push_back(draft->resolve(octant));
    }
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
  }

  const OctreeBuilder<P>& builder_;
};

}  // namespace grove
