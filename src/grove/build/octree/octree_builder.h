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

/// Chooses where a cell is cut, by its set alone; no axis is cut (OctantCut::axes 0) where that is not worth it. `places` are those of the set's references.
/// `Scratch` is what a task needs for itself.
template <typename P>
concept OctreePlanes = requires(const P& planes, const OctantSource& source, const Box4& cell, std::span<const std::uint32_t> places,
                                typename P::Scratch& scratch) {
  { planes.choose(source, cell, places, scratch) } -> std::same_as<OctantCut>;
};

namespace detail {

/// Smaller sets are built by one task.
inline constexpr std::size_t kOctreeTaskSize = 8192;

/// A cell on its way to become a node.
struct OctreeCell {
  Box4 box;
  std::uint32_t depth = 0;
  /// How many references the subtree may make.
  std::uint64_t capacity = 0;
  std::uint32_t bad_cuts = 0;
};

template <OctreePlanes P>
class OctreeBuilder {
 public:
  OctreeBuilder(const P& planes, const OctantSource& source, const OctreeSettings& settings, std::uint32_t most_depth)
      : planes_(planes), source_(source), settings_(settings), most_depth_(most_depth) {}

  /// Tasks above, one task's work below. `places` is emptied.
  OctreeDraft build(Places& places, const OctreeCell& cell) const {
    if (places.size() <= kOctreeTaskSize) return Subtree(*this).build(places, cell);
    OctantSets sets;
    OctantCut cut;
    {
      typename P::Scratch scratch;
      if (!part(places, cell, scratch, cut, sets)) return Subtree(*this).leaf_only(places);
    }
    const std::uint32_t bad_cuts = cell.bad_cuts + (is_bad(cut, sets, places.size()) ? 1 : 0);
    Places().swap(places);
    OctreeDraft draft;
    draft.root = DraftSlot::node(0);
    DraftNode& node = draft.nodes.emplace_back();
    node.planes = to_vec3(cut.planes);
    node.cut_axes = static_cast<std::uint8_t>(cut.axes);
    append_references(source_, sets.own(), draft.references);
    node.own = {0, static_cast<std::uint32_t>(draft.references.size())};
    std::vector<std::uint32_t> octants;
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
      if (sets.count(octant) == 0) continue;
      node.octants[octant] = DraftSlot::part(octants.size());
      octants.push_back(octant);
    }
    draft.parts.resize(octants.size());
    parallel_for(octants.size(), 1, [&](std::size_t i) {
      const std::span<const std::uint32_t> set = sets.of(octants[i]);
      Places child(set.begin(), set.end());
      draft.parts[i] = std::make_unique<OctreeDraft>(build(child, child_cell(cell, cut, sets, octants[i], bad_cuts)));
    });
    return draft;
  }

 private:
  class Subtree;

  // Whether a set is to be cut; if so, where, and what lies in each octant.
  bool part(std::span<const std::uint32_t> places, const OctreeCell& cell, typename P::Scratch& scratch, OctantCut& cut,
            OctantSets& sets) const {
    if (places.size() <= settings_.leaf_size || cell.depth >= most_depth_) return false;
    cut = planes_.choose(source_, cell.box, places, scratch);
    if (cut.axes == 0) return false;
    sets.part(source_, cut, places, settings_.store);
    return sets.total() <= cell.capacity && (cell.bad_cuts < settings_.bad_cuts || !is_bad(cut, sets, places.size()));
  }

  // Whether a cut, with leaves below, would cost more than a leaf in its place. Only octree-R asks.
  bool is_bad(const OctantCut& cut, const OctantSets& sets, std::size_t count) const {
    if (settings_.split == OctreeSplit::median) return false;
    double tests = static_cast<double>(sets.own().size());
    for (std::uint32_t octant = 0; octant < 8; ++octant) tests += chance_of_octant(cut, octant) * sets.count(octant);
    return ray_cost(1.0, settings_.cost.traversal, tests, settings_.cost.intersection) > leaf_cost(count);
  }

  [[nodiscard]] double leaf_cost(std::size_t count) const { return settings_.cost.intersection * static_cast<double>(count); }

  // Room for more references is shared in proportion to those that there are.
  static OctreeCell child_cell(const OctreeCell& cell, const OctantCut& cut, const OctantSets& sets, std::uint32_t octant,
                               std::uint32_t bad_cuts) {
    const std::uint64_t count = sets.count(octant);
    const std::uint64_t slack = cell.capacity - sets.total();
    const auto share =
        static_cast<std::uint64_t>(static_cast<double>(slack) * static_cast<double>(count) / static_cast<double>(sets.total()));
    return {cut.octant(octant), cell.depth + 1, count + share, bad_cuts};
  }

  const P& planes_;
  const OctantSource& source_;
  const OctreeSettings& settings_;
  std::uint32_t most_depth_;
};

/// One task's work: recursion over sets that are kept by level and used again.
template <OctreePlanes P>
class OctreeBuilder<P>::Subtree {
 public:
  explicit Subtree(const OctreeBuilder& builder) : builder_(builder) {}

  OctreeDraft build(std::span<const std::uint32_t> places, const OctreeCell& cell) {
    first_depth_ = cell.depth;
    draft_.root = build_slot(places, cell).slot;
    return std::move(draft_);
  }

  OctreeDraft leaf_only(std::span<const std::uint32_t> places) {
    draft_.root = make_leaf(places).slot;
    return std::move(draft_);
  }

 private:
  // What was made, and what it costs a ray that passes through its cell.
  struct Built {
    DraftSlot slot;
    double cost;
  };

  Built build_slot(std::span<const std::uint32_t> places, const OctreeCell& cell) {
    const std::size_t level = cell.depth - first_depth_;
    if (levels_.size() <= level) levels_.push_back(std::make_unique<OctantSets>());
    OctantSets& sets = *levels_[level];
    OctantCut cut;
    if (!builder_.part(places, cell, scratch_, cut, sets)) return make_leaf(places);
    const std::uint32_t bad_cuts = cell.bad_cuts + (builder_.is_bad(cut, sets, places.size()) ? 1 : 0);
    const std::size_t number = draft_.nodes.size();
    const std::size_t first_leaf = draft_.leaves.size();
    const std::size_t first_reference = draft_.references.size();
    DraftNode node;
    node.planes = to_vec3(cut.planes);
    node.cut_axes = static_cast<std::uint8_t>(cut.axes);
    node.own = append(sets.own());
    double cost = builder_.settings_.cost.traversal + builder_.leaf_cost(node.own.count);
    draft_.nodes.push_back(node);
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
      if (sets.count(octant) == 0) continue;
      const Built built = build_slot(sets.of(octant), child_cell(cell, cut, sets, octant, bad_cuts));
      draft_.nodes[number].octants[octant] = built.slot;
      cost += chance_of_octant(cut, octant) * built.cost;
    }
    if (builder_.settings_.split == OctreeSplit::median || cost < builder_.leaf_cost(places.size())) return {DraftSlot::node(number), cost};
    draft_.nodes.resize(number);
    draft_.leaves.resize(first_leaf);
    draft_.references.resize(first_reference);
    return make_leaf(places);
  }

  DraftLeaf append(std::span<const std::uint32_t> places) {
    const auto first = static_cast<std::uint32_t>(draft_.references.size());
    append_references(builder_.source_, places, draft_.references);
    return {first, static_cast<std::uint32_t>(places.size())};
  }

  Built make_leaf(std::span<const std::uint32_t> places) {
    draft_.leaves.push_back(append(places));
    return {DraftSlot::leaf(draft_.leaves.size() - 1), builder_.leaf_cost(places.size())};
  }

  const OctreeBuilder& builder_;
  OctreeDraft draft_;
  typename P::Scratch scratch_;
  std::vector<std::unique_ptr<OctantSets>> levels_;
  std::uint32_t first_depth_ = 0;
};

}  // namespace detail
}  // namespace grove
