#pragma once

// Merges octrees over the same cell into one (section IV.A of the review: subsets of the primitives build local octrees, which are merged into a global one).
//
// The result is the octree that building from all primitives at once gives, bit for bit. That holds because the planes of a cell do not depend on what is in
// it, and whether a cell is cut depends on numbers alone: how many primitives it has, and how many its octants would have, which are sums over the local trees.
// Where a local tree has cut a cell that the whole one does not, its leaves are gathered again; where it has not, its leaf is parted now.
//
// Bringing an octree up to date is the same: the tree without what has changed is merged with the set of what has. Subtrees that meet nothing stay as they are.

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "grove/base/parallel.h"
#include "grove/build/octree/changed_octree.h"
#include "grove/build/octree/octree_builder.h"

namespace grove {

/// One of several things that fill a cell together: a subtree of a draft, one of an octree that is being updated, or a set that no tree has parted yet.
class OctreeItem {
 public:
  [[nodiscard]] static OctreeItem subtree(OctreeDraft::Place place) {
    OctreeItem item;
    if (place.slot.kind() == DraftSlot::Kind::leaf) return set(place.draft->ids_of_leaf(place.slot));
    item.draft_ = place.draft;
    item.number_ = place.slot.number();
    item.count_ = item.draft_node().count;
    return item;
  }
  [[nodiscard]] static OctreeItem subtree(const ChangedOctree& octree, std::uint32_t number) {
    OctreeItem item;
    item.octree_ = &octree;
    item.number_ = number;
    item.count_ = octree.primitive_count(number);
    item.is_kept_ = octree.is_kept(number);
    return item;
  }
  /// Ascending ids. `is_kept`: they are a leaf of an octree that is being updated.
  [[nodiscard]] static OctreeItem set(std::span<const std::uint32_t> ids, bool is_kept = false) {
    OctreeItem item;
    item.ids_.assign(ids.begin(), ids.end());
    item.count_ = ids.size();
    item.is_kept_ = is_kept;
    return item;
  }

  [[nodiscard]] bool is_node() const { return draft_ != nullptr || octree_ != nullptr; }
  [[nodiscard]] const OctreeDraft* draft() const { return draft_; }
  [[nodiscard]] const ChangedOctree* octree() const { return octree_; }
  [[nodiscard]] std::uint32_t number() const { return number_; }
  [[nodiscard]] const DraftNode& draft_node() const { return draft_->nodes[number_]; }
  [[nodiscard]] std::span<const std::uint32_t> ids() const { return ids_; }
  [[nodiscard]] std::size_t count() const { return count_; }
  /// Whether it is what it was in the octree that is being updated.
  [[nodiscard]] bool is_kept() const { return is_kept_; }

  /// How a node cuts its cell.
  [[nodiscard]] OctantCut cut(const Box4& cell) const {
    if (draft_ != nullptr) return {cell, to_float4(draft_node().planes), draft_node().cut_axes};
    const OctreeNode& node = octree_->node(number_);
    return {cell, Float4{node.planes[0], node.planes[1], node.planes[2], 0.0F}, node.cut_axes};
  }

 private:
  const OctreeDraft* draft_ = nullptr;
  const ChangedOctree* octree_ = nullptr;
  std::uint32_t number_ = 0;
  std::vector<std::uint32_t> ids_;
  std::size_t count_ = 0;
  bool is_kept_ = false;
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
    void keep(std::span<const std::uint32_t> ids) { own.insert(own.end(), ids.begin(), ids.end()); }
  };

  DraftSlot merge(const std::vector<OctreeItem>& items, const OctreeCell& cell, Task& task) const {
    if (items.empty()) return {};
    if (items.size() == 1 && items[0].is_kept())
      return items[0].is_node() ? DraftSlot::kept(items[0].number()) : task.draft.add_leaf(items[0].ids());
    std::size_t count = 0;
    const OctreeItem* cut_by = nullptr;
    for (const OctreeItem& item : items) {
      count += item.count();
      if (item.is_node()) cut_by = &item;
    }
    if (cut_by == nullptr && count <= kOctreeTaskSize) return task.subtree.build(gather(items), cell);
    if (cut_by == nullptr) {
      task.draft.parts.push_back(std::make_unique<OctreeDraft>(builder_.build(gather(items), cell)));
      return DraftSlot::part(task.draft.parts.size() - 1);
    }
    if (builder_.is_small(count, cell)) return task.draft.add_leaf(gather(items));
    const OctantCut cut = cut_by->cut(cell.box);
    const Parted parted = part(items, cut);
    if (parted.total > cell.capacity) return task.draft.add_leaf(gather(items));

    const DraftSlot slot = task.draft.add_node(to_vec3(cut.planes), cut.axes, count, parted.own);
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

  Parted part(const std::vector<OctreeItem>& items, const OctantCut& cut) const {
    Parted parted;
    for (const OctreeItem& item : items) {
      if (item.draft() != nullptr) {
        part_draft(item, parted);
      } else if (item.octree() != nullptr) {
        part_octree(item, parted);
      } else {
        part_set(item.ids(), cut, parted);
      }
    }
    std::sort(parted.own.begin(), parted.own.end());
    return parted;
  }

  static void part_draft(const OctreeItem& item, Parted& parted) {
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
      const OctreeDraft::Place place = item.draft()->resolve(item.draft_node().octants[octant]);
      if (place.slot.kind() != DraftSlot::Kind::empty) parted.add(octant, OctreeItem::subtree(place));
    }
    parted.keep(item.draft()->ids_of(item.draft_node().own));
  }

  static void part_octree(const OctreeItem& item, Parted& parted) {
    const ChangedOctree& octree = *item.octree();
    const OctreeNode& node = octree.node(item.number());
    std::vector<std::uint32_t> ids;
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
      if ((node.interior_mask >> octant & 1U) != 0 && octree.reference_count(node.child(octant)) > 0)
        parted.add(octant, OctreeItem::subtree(octree, node.child(octant)));
      if ((node.leaf_mask >> octant & 1U) == 0) continue;
      ids.clear();
      octree.append_leaf(node.leaf(octant), ids);
      if (!ids.empty()) parted.add(octant, OctreeItem::set(ids, octree.is_leaf_kept(node.leaf(octant))));
    }
    ids.clear();
    if (node.has_own != 0) octree.append_leaf(node.first_leaf, ids);
    parted.keep(ids);
  }

  void part_set(std::span<const std::uint32_t> ids, const OctantCut& cut, Parted& parted) const {
    OctantSets sets;
    sets.part(builder_.source(), cut, ids, builder_.settings().store);
    for (std::uint32_t octant = 0; octant < 8; ++octant)
      if (sets.count(octant) > 0) parted.add(octant, OctreeItem::set(sets.of(octant)));
    parted.keep(sets.own());
  }

  // All primitives of the items, each once.
  static std::vector<std::uint32_t> gather(const std::vector<OctreeItem>& items) {
    std::vector<std::uint32_t> ids;
    for (const OctreeItem& item : items) {
      ids.insert(ids.end(), item.ids().begin(), item.ids().end());
      if (item.octree() != nullptr) item.octree()->append_all(item.number(), ids);
      if (item.draft() != nullptr) append_all({item.draft(), DraftSlot::node(item.number())}, ids);
    }
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
  }

  static void append_all(const OctreeDraft::Place& place, std::vector<std::uint32_t>& ids) {
    if (place.slot.kind() == DraftSlot::Kind::empty) return;
    const bool is_node = place.slot.kind() == DraftSlot::Kind::node;
    const std::span<const std::uint32_t> here =
        is_node ? place.draft->ids_of(place.draft->nodes[place.slot.number()].own) : place.draft->ids_of_leaf(place.slot);
    ids.insert(ids.end(), here.begin(), here.end());
    if (!is_node) return;
    for (const DraftSlot octant : place.draft->nodes[place.slot.number()].octants) append_all(place.draft->resolve(octant), ids);
  }

  const OctreeBuilder<P>& builder_;
};

}  // namespace grove
