#pragma once

// Refitting: the boxes of a hierarchy are measured anew from the leaves up, the topology stays. What moving vertices call for when they have not
// moved far; how far is told by the cost, which grows as boxes come to overlap.

#include <concepts>
#include <cstdint>
#include <type_traits>

#include "grove/accel/bvh2.h"
#include "grove/accel/wide_bvh.h"
#include "grove/base/parallel.h"
#include "grove/build/cost_model.h"
#include "grove/build/hierarchy_part.h"
#include "grove/build/split.h"
#include "grove/math/float4.h"

namespace grove {

/// The bounds of references [first, first + count) as they are now. May be called by several threads, for different leaves.
template <typename F>
concept LeafBounds = requires(const F& leaf_bounds, std::uint32_t first) {
  { leaf_bounds(first, first) } -> std::same_as<Box4>;
};

/// Down to this depth both sides of a binary node are handled side by side: 512 subtrees. Wider nodes reach as many on fewer levels.
inline constexpr std::uint32_t kUpdateTaskDepth = 9;

namespace detail {

// How a pass goes through the nodes of any hierarchy over boxes.
template <typename Node>
inline constexpr std::uint32_t kTaskDepth = kUpdateTaskDepth;
template <>
inline constexpr std::uint32_t kTaskDepth<WideNode<4>> = (kUpdateTaskDepth + 1) / 2;
template <>
inline constexpr std::uint32_t kTaskDepth<WideNode<8>> = kUpdateTaskDepth / 3;

inline int child_count(const Bvh2Node& /*node*/) {
  return 2;
}
inline void set_child_boxes(Bvh2Node& node, const Box4* boxes, int /*count*/) {
  set_children(node, boxes[0], boxes[1]);
}
template <int kWidth>
int child_count(const WideNode<kWidth>& node) {
  int count = 0;
  while (count < kWidth && node.has_child(count)) ++count;
  return count;
}
template <int kWidth>
void set_child_boxes(WideNode<kWidth>& node, const Box4* boxes, int count) {
  for (int i = 0; i < count; ++i) node.set_child(i, boxes[i].box(), node.child[i]);
}

}  // namespace detail

/// A hierarchy whose nodes hold the boxes of their children: a Bvh2 or a WideBvh.
template <typename H>
concept BoxHierarchy = requires(const H& hierarchy) {
  detail::child_count(hierarchy.nodes.front());
};

namespace detail {

template <BoxHierarchy Hierarchy, LeafBounds F>
class Refitter {
 public:
  Refitter(Hierarchy& hierarchy, const F& leaf_bounds, const CostModel& cost, float area_scale)
      : hierarchy_(hierarchy), leaf_bounds_(leaf_bounds), cost_(cost), area_scale_(area_scale) {}

  struct Refitted {
    Box4 box;
    double cost;  ///< of the subtree, times area
  };

  Refitted refit(std::uint32_t first, std::uint32_t count, std::uint32_t depth) const {
    Refitted result{Box4::empty(), 0.0};
    if (count > 0) {
      result.box = leaf_bounds_(first, count);
      result.cost = cost_.intersection * count * static_cast<double>(scaled_half_area(result.box, area_scale_));
      return result;
    }
    auto& node = hierarchy_.nodes[first];
    const int children = child_count(node);
    Box4 boxes[kMostChildren] = {};
    double costs[kMostChildren] = {};
    const auto refit_child = [&](int i) {
      const Refitted child = refit(node.child[i].first, node.child[i].count, depth + 1);
      boxes[i] = child.box;
      costs[i] = child.cost;
    };
    if (depth < kTaskDepth<std::remove_reference_t<decltype(node)>>) {
      parallel_for(static_cast<std::size_t>(children), 1, [&](std::size_t i) { refit_child(static_cast<int>(i)); });
    } else {
      for (int i = 0; i < children; ++i) refit_child(i);
    }
    set_child_boxes(node, boxes, children);
    for (int i = 0; i < children; ++i) {
      result.box.grow(boxes[i]);
      result.cost += costs[i];
    }
    result.cost += cost_.traversal * static_cast<double>(scaled_half_area(result.box, area_scale_));
    return result;
  }

 private:
  static constexpr int kMostChildren = 8;

  Hierarchy& hierarchy_;
  const F& leaf_bounds_;
  const CostModel& cost_;
  float area_scale_;
};

}  // namespace detail

/// Measures all boxes of `hierarchy` anew and returns its expected cost (build/cost_model.h), or infinity or NaN where
/// boxes have grown beyond all measure. No leaf's bounds may be empty. O(references), parallel; the same for any number of threads.
template <BoxHierarchy Hierarchy, LeafBounds F>
double refit(Hierarchy& hierarchy, const F& leaf_bounds, const CostModel& cost = {}) {
  if (hierarchy.references.empty()) return 0.0;
  const float scale = AreaMeasure(hierarchy.bounds).scale();
  const detail::Refitter<Hierarchy, F> refitter(hierarchy, leaf_bounds, cost, scale);
  const auto leaf_size = hierarchy.nodes.empty() ? static_cast<std::uint32_t>(hierarchy.references.size()) : 0U;
  const auto root = refitter.refit(0, leaf_size, 0);
  hierarchy.bounds = root.box.box();
  const auto area = static_cast<double>(scaled_half_area(root.box, scale));
  // A scene without area is met in all its nodes by every ray that meets it, which no ratio of areas tells: measured the long way.
  return area > 0.0 ? root.cost / area : expected_cost(hierarchy, cost);
}

}  // namespace grove
