#pragma once

// Builds a kd-tree from the root down, whatever finds the planes: recursion, tasks, depth, when to stop, and how many references there may be.
//
// A set stops being parted when it is small or deep enough, or when no plane is cheaper than a leaf has been found several times over (after Pharr and
// Humphreys 2004). What such hope has made in vain is taken back: a subtree that costs more than one leaf in its place becomes that leaf.

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "grove/base/parallel.h"
#include "grove/build/kd_tree/kd_cell.h"
#include "grove/build/kd_tree/kd_plane.h"
#include "grove/build/kd_tree/kd_tree_part.h"
#include "grove/build/kd_tree/kd_tree_settings.h"
#include "grove/build/kd_tree/part_references.h"

namespace grove {

/// Finds planes and parts sets. `Set` holds at least `references`; `Scratch` is what a task needs for itself. Both functions do large sets in parallel, and
/// their results depend on the set alone. A finder may hand small sets to another, for_small_sets().
template <typename P>
concept KdPlaneFinder = requires(const P& finder, const typename P::Set& set, const Box4& cell, const KdPlane& plane,
                                 typename P::Set* const* sides, typename P::Scratch& scratch) {
  { set.references } -> std::convertible_to<const References&>;
  { finder.find(set, cell, scratch) } -> std::same_as<KdPlane>;
  finder.part(set, plane, sides, scratch);
  { finder.costs() } -> std::same_as<const KdCostContext&>;
};

namespace detail {

/// Smaller sets are built by one task.
inline constexpr std::size_t kKdTaskSize = 4096;

template <KdPlaneFinder P>
class KdBuilder {
 public:
  using Set = typename P::Set;

  KdBuilder(const P& finder, const KdTreeSettings& settings, std::uint32_t most_depth)
      : finder_(finder), settings_(settings), most_depth_(most_depth) {}

  /// Tasks above, one task's work below.
  KdTreePart build(Set set, const KdCell& cell) const {
    if (set.references.size() <= kKdTaskSize) {
      if constexpr (requires { finder_.for_small_sets(); }) {
        const auto finder = finder_.for_small_sets();
        return KdBuilder<std::remove_const_t<decltype(finder)>>(finder, settings_, most_depth_)
            .build(finder.make_set(std::move(set.references)), cell);
      } else {
        return Subtree(*this).build(set, cell);
      }
    }
    KdPlane plane;
    KdCell cells[2];
    Set sets[2];
    {
      typename P::Scratch scratch;
      if (!choose(set, cell, scratch, plane)) return Subtree(*this).leaf_only(set, cell);
      Set* const sides[2] = {&sets[0], &sets[1]};
      finder_.part(set, plane, sides, scratch);
    }
    descend(set, cell, plane, sets[0], sets[1], cells);
    set = Set();
    KdTreePart part;
    part.axis = plane.axis;
    part.position = plane.position;
    parallel_invoke([&] { part.children[0] = std::make_unique<KdTreePart>(build(std::move(sets[0]), cells[0])); },
                    [&] { part.children[1] = std::make_unique<KdTreePart>(build(std::move(sets[1]), cells[1])); });
    part.depth = std::max(part.children[0]->depth, part.children[1]->depth);
    return part;
  }

 private:
  class Subtree;

  // Whether a set is to be parted, and by which plane.
  bool choose(const Set& set, const KdCell& cell, typename P::Scratch& scratch, KdPlane& plane) const {
    const auto count = static_cast<std::uint32_t>(set.references.size());
    if (count <= settings_.leaf_size || cell.depth >= most_depth_) return false;
    plane = finder_.find(set, cell.box, scratch);
    if (!plane.is_possible || std::uint64_t{plane.lower_count} + plane.upper_count > cell.capacity) return false;
    return !is_bad(plane, count) || cell.bad_planes < settings_.bad_planes;
  }

  [[nodiscard]] bool is_bad(const KdPlane& plane, std::uint32_t count) const {
    return plane.cost > static_cast<float>(settings_.cost.intersection) * static_cast<float>(count);
  }

  // The children's cells. Room for more references is shared in proportion to those that there are.
  void descend(const Set& set, const KdCell& cell, const KdPlane& plane, const Set& lower, const Set& upper, KdCell cells[2]) const {
    const std::uint64_t lower_count = lower.references.size();
    const std::uint64_t upper_count = upper.references.size();
    const std::uint64_t slack = cell.capacity - lower_count - upper_count;
    const auto share = static_cast<std::uint64_t>(static_cast<double>(slack) * static_cast<double>(lower_count) /
                                                  static_cast<double>(std::max<std::uint64_t>(lower_count + upper_count, 1)));
    const std::uint32_t bad = cell.bad_planes + (is_bad(plane, static_cast<std::uint32_t>(set.references.size())) ? 1 : 0);
    cells[0] = cell.child(0, plane, bad, lower_count + share);
    cells[1] = cell.child(1, plane, bad, upper_count + slack - share);
  }

  const P& finder_;
  const KdTreeSettings& settings_;
  std::uint32_t most_depth_;
};

/// One task's work: recursion over sets that are kept by level and used again.
template <KdPlaneFinder P>
class KdBuilder<P>::Subtree {
 public:
  explicit Subtree(const KdBuilder& builder) : builder_(builder) {}

  KdTreePart build(const Set& set, const KdCell& cell) {
    first_depth_ = cell.depth;
    part_.nodes.resize(2, KdNode::leaf(0, 0));
    part_.depth = build_node(set, cell, 0).depth;
    return std::move(part_);
  }

  KdTreePart leaf_only(const Set& set, const KdCell& cell) {
    part_.nodes.resize(2, KdNode::leaf(0, 0));
    part_.depth = cell.depth;
    make_leaf(set, 0);
    return std::move(part_);
  }

 private:
  struct Level {
    Set sets[2];
  };

  // A subtree's cost times the area of its cell, and the depth of its deepest leaf.
  struct Built {
    float cost;
    std::uint32_t depth;
  };

  Built build_node(const Set& set, const KdCell& cell, std::uint32_t node) {
    const float area = builder_.finder_.costs().measure(cell.box);
    const float leaf_cost = area * static_cast<float>(builder_.settings_.cost.intersection) * static_cast<float>(set.references.size());
    KdPlane plane;
    if (!builder_.choose(set, cell, scratch_, plane)) {
      make_leaf(set, node);
      return {leaf_cost, cell.depth};
    }
    const std::size_t level = cell.depth - first_depth_;
    if (levels_.size() <= level) levels_.push_back(std::make_unique<Level>());
    Level& sides = *levels_[level];
    Set* const sets[2] = {&sides.sets[0], &sides.sets[1]};
    builder_.finder_.part(set, plane, sets, scratch_);
    KdCell cells[2];
    builder_.descend(set, cell, plane, sides.sets[0], sides.sets[1], cells);

    const std::size_t first_node = part_.nodes.size();
    const std::size_t first_reference = part_.references.size();
    const auto pair = static_cast<std::uint32_t>(first_node);
    part_.nodes.resize(first_node + 2, KdNode::leaf(0, 0));
    part_.nodes[node] = KdNode::interior(plane.axis, plane.position, pair);
    const Built lower = build_node(sides.sets[0], cells[0], pair);
    const Built upper = build_node(sides.sets[1], cells[1], pair + 1);
    const Built parted{area * static_cast<float>(builder_.settings_.cost.traversal) + lower.cost + upper.cost,
                       std::max(lower.depth, upper.depth)};
    if (parted.cost < leaf_cost) return parted;
    part_.nodes.resize(first_node, KdNode::leaf(0, 0));
    part_.references.resize(first_reference);
    make_leaf(set, node);
    return {leaf_cost, cell.depth};
  }

  void make_leaf(const Set& set, std::uint32_t node) {
    const auto first = static_cast<std::uint32_t>(part_.references.size());
    for (const PrimitiveReference& reference : set.references) part_.references.push_back(reference.primitive());
    std::sort(part_.references.begin() + first, part_.references.end());
    part_.nodes[node] = KdNode::leaf(first, static_cast<std::uint32_t>(set.references.size()));
  }

  const KdBuilder& builder_;
  KdTreePart part_;
  typename P::Scratch scratch_;
  std::vector<std::unique_ptr<Level>> levels_;
  std::uint32_t first_depth_ = 0;
};

}  // namespace detail
}  // namespace grove
