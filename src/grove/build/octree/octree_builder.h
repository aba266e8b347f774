#pragma once

// Builds a draft of an octree from the root down, whatever chooses the planes: recursion, tasks, depth, when to stop, and how many references there may be.
//
// An octree is cut until leaves are small or deep enough. Octree-R stops besides where cuts cost more than they save, once that has happened several times
// above each other; what such hope has made in vain is taken back: a subtree that costs more than one leaf in its place becomes that leaf.

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "grove/base/parallel.h"
#include "grove/build/octree/octree_draft.h"
#include "grove/build/octree/octree_r_cost.h"
#include "grove/build/octree/octree_settings.h"
#include "grove/build/octree/part_octants.h"

namespace grove {

/// Chooses where a cell is cut, by its set alone; no axis is cut (OctantCut::axes 0) where that is not possible. `Scratch` is what a task needs for itself.
template <typename P>
concept OctreePlanes = requires(const P& planes, const OctantSource& source, const Box4& cell, std::span<const std::uint32_t> ids,
                                typename P::Scratch& scratch) {
  { planes.choose(source, cell, ids, scratch) } -> std::same_as<OctantCut>;
};

/// Smaller sets are built by one task.
inline constexpr std::size_t kOctreeTaskSize = 8192;

/// A cell on its way to become a node.
struct OctreeCell {
  Box4 box;
  std::uint32_t depth = 0;
  /// How many references the subtree may make.
  std::uint64_t capacity = 0;
  std::uint32_t bad_cuts = 0;

  /// The cell of an octant that gets `count` of `total` references. Room for more is shared in proportion to those that there are.
  [[nodiscard]] OctreeCell octant(const OctantCut& cut, std::uint32_t number, std::uint64_t count, std::uint64_t total,
                                  std::uint32_t bad_so_far) const {
    const double share = static_cast<double>(capacity - total) * static_cast<double>(count) / static_cast<double>(total);
    return {cut.octant(number), depth + 1, count + static_cast<std::uint64_t>(share), bad_so_far};
  }
};

template <OctreePlanes P>
class OctreeBuilder {
 public:
  class Subtree;

  OctreeBuilder(const P& planes, const OctantSource& source, const OctreeSettings& settings, std::uint32_t most_depth)
      : planes_(planes), source_(source), settings_(settings), most_depth_(most_depth) {}

  [[nodiscard]] const OctantSource& source() const { return source_; }
  [[nodiscard]] const OctreeSettings& settings() const { return settings_; }

  /// Whether a set is a leaf whatever is in it.
  [[nodiscard]] bool is_small(std::size_t count, const OctreeCell& cell) const {
    return count <= settings_.largest_leaf() || cell.depth >= most_depth_;
  }

  /// Tasks above, one task's work below.
  [[nodiscard]] OctreeDraft build(std::span<const std::uint32_t> ids, const OctreeCell& cell) const {
    OctreeDraft draft;
    if (ids.size() <= kOctreeTaskSize) {
      draft.root = Subtree(*this, draft).build(ids, cell);
      return draft;
    }
    OctantSets sets;
    OctantCut cut;
    {
      typename P::Scratch scratch;
      if (!part(ids, cell, scratch, cut, sets)) {
        draft.root = draft.add_leaf(ids);
        return draft;
      }
    }
    const std::uint32_t bad_cuts = cell.bad_cuts + (is_bad(cut, sets, ids.size()) ? 1 : 0);
    draft.root = draft.add_node(to_vec3(cut.planes), cut.axes, ids.size(), sets.own());
    std::vector<std::uint32_t> octants;
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
      if (sets.count(octant) == 0) continue;
      draft.nodes[0].octants[octant] = DraftSlot::part(octants.size());
      octants.push_back(octant);
    }
    draft.parts.resize(octants.size());
    parallel_for(octants.size(), 1, [&](std::size_t i) {
      const std::uint32_t octant = octants[i];
      const OctreeCell child = cell.octant(cut, octant, sets.count(octant), sets.total(), bad_cuts);
      draft.parts[i] = std::make_unique<OctreeDraft>(build(sets.of(octant), child));
    });
    return draft;
  }

 private:
  // Whether a set is to be cut; if so, where, and what lies in each octant.
  bool part(std::span<const std::uint32_t> ids, const OctreeCell& cell, typename P::Scratch& scratch, OctantCut& cut,
            OctantSets& sets) const {
    if (is_small(ids.size(), cell)) return false;
    cut = planes_.choose(source_, cell.box, ids, scratch);
    if (cut.axes == 0) return false;
    sets.part(source_, cut, ids, settings_.store);
    return sets.total() <= cell.capacity && (cell.bad_cuts < settings_.bad_cuts || !is_bad(cut, sets, ids.size()));
  }

  // Whether a cut, with leaves below, would cost more than a leaf in its place. Only octree-R asks.
  bool is_bad(const OctantCut& cut, const OctantSets& sets, std::size_t count) const {
    if (settings_.split == OctreeSplit::median) return false;
    auto tests = static_cast<double>(sets.own().size());
    for (std::uint32_t octant = 0; octant < 8; ++octant) tests += chance_of_octant(cut, octant) * sets.count(octant);
    return ray_cost(1.0, settings_.cost.traversal, tests, settings_.cost.intersection) > leaf_cost(count);
  }

  [[nodiscard]] double leaf_cost(std::size_t count) const { return settings_.cost.intersection * static_cast<double>(count); }

  const P& planes_;
  const OctantSource& source_;
  const OctreeSettings& settings_;
  std::uint32_t most_depth_;
};

/// One task's work: recursion over sets that are kept by level and used again. What is built is added to a draft.
template <OctreePlanes P>
class OctreeBuilder<P>::Subtree {
 public:
  Subtree(const OctreeBuilder& builder, OctreeDraft& draft) : builder_(builder), draft_(draft) {}

  DraftSlot build(std::span<const std::uint32_t> ids, const OctreeCell& cell) { return build_slot(ids, cell, 0).slot; }

 private:
  // What was made, and what it costs a ray that passes through its cell.
  struct Built {
    DraftSlot slot;
    double cost;
  };

  Built build_slot(std::span<const std::uint32_t> ids, const OctreeCell& cell, std::size_t level) {
    if (levels_.size() <= level) levels_.push_back(std::make_unique<OctantSets>());
    OctantSets& sets = *levels_[level];
    OctantCut cut;
    if (!builder_.part(ids, cell, scratch_, cut, sets)) return make_leaf(ids);
    const std::uint32_t bad_cuts = cell.bad_cuts + (builder_.is_bad(cut, sets, ids.size()) ? 1 : 0);
    const OctreeDraft::Mark before = draft_.mark();
    const DraftSlot slot = draft_.add_node(to_vec3(cut.planes), cut.axes, ids.size(), sets.own());
    double cost = builder_.settings_.cost.traversal + builder_.leaf_cost(sets.own().size());
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
      if (sets.count(octant) == 0) continue;
      const OctreeCell child = cell.octant(cut, octant, sets.count(octant), sets.total(), bad_cuts);
      const Built built = build_slot(sets.of(octant), child, level + 1);
      draft_.nodes[slot.number()].octants[octant] = built.slot;
      cost += chance_of_octant(cut, octant) * built.cost;
    }
    if (builder_.settings_.split == OctreeSplit::median || cost < builder_.leaf_cost(ids.size())) return {slot, cost};
    draft_.take_back(before);
    return make_leaf(ids);
  }

  Built make_leaf(std::span<const std::uint32_t> ids) { return {draft_.add_leaf(ids), builder_.leaf_cost(ids.size())}; }

  const OctreeBuilder& builder_;
  OctreeDraft& draft_;
  typename P::Scratch scratch_;
  std::vector<std::unique_ptr<OctantSets>> levels_;
};

}  // namespace grove
