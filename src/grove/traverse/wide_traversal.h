#pragma once

// Ordered depth-first traversal of a wide hierarchy: all children of a node are tested four at a time, those that are met are entered near to
// far, or the largest first. Otherwise as traverse/bvh2_traversal.h.

#include <bit>
#include <cstdint>
#include <type_traits>

#include "grove/accel/bvh2.h"
#include "grove/accel/wide_bvh.h"
#include "grove/geometry/geometry_concept.h"
#include "grove/math/float4.h"
#include "grove/traverse/slab_ray.h"
#include "grove/traverse/traversal_record.h"
#include "grove/traverse/walk_order.h"

namespace grove {

/// The box tests of a wide node for one ray.
template <int kWidth>
class WideSlabs {
 public:
  explicit WideSlabs(const SlabRay& ray) {
    for (int axis = 0; axis < 3; ++axis) {
      origin_near_[axis] = splat(ray.origin_near[axis]);
      origin_far_[axis] = splat(ray.origin_far[axis]);
      inverse_near_[axis] = splat(ray.inverse_near[axis]);
      inverse_far_[axis] = splat(ray.inverse_far[axis]);
      near_[axis] = ray.negative[axis] ? 1 : 0;
    }
  }

  /// Writes the entry distances of all places; bit i of the result is set where child i is met within [t_min, t_max]. The node has
  /// `planes` as WideNode has.
  template <typename Node>
  [[nodiscard, gnu::always_inline]] unsigned test(const Node& node, Float4 t_min, Float4 t_max, float* entry) const {
    unsigned met = 0;
    for (int group = 0; group < kWidth / 4; ++group) {
      // min and max keep the second operand where the first is NaN: a ray inside a plane is not limited by it.
      Float4 near = t_min;
      Float4 far = t_max;
      for (int axis = 0; axis < 3; ++axis) {
        near = max((load4(node.planes[axis][near_[axis]] + 4 * group) - origin_near_[axis]) * inverse_near_[axis], near);
        far = min((load4(node.planes[axis][1 - near_[axis]] + 4 * group) - origin_far_[axis]) * inverse_far_[axis], far);
      }
      __builtin_memcpy(entry + 4 * group, &near, sizeof near);
      met |= static_cast<unsigned>(four_lanes(near <= far)) << (4 * group);
    }
    return met;
  }

 private:
  Float4 origin_near_[3];
  Float4 origin_far_[3];
  Float4 inverse_near_[3];
  Float4 inverse_far_[3];
  int near_[3];
};

/// What tells one leaf of a hierarchy from another: where its references, or its block, begin.
template <typename Child>
[[nodiscard]] std::uint32_t leaf_number(Child leaf) {
  if constexpr (requires { leaf.unit(); }) {
    return leaf.unit();
  } else {
    return leaf.first;
  }
}

/// What WideSlabs tests: a node that has planes, or the boxes that it tells.
template <typename Node>
[[nodiscard]] decltype(auto) boxes_of(const Node& node) {
  if constexpr (requires { node.boxes(); }) {
    return node.boxes();
  } else {
    return (node);
  }
}

/// Writes half the surfaces of the boxes of all places; unused ones mean nothing. The node has `planes` as WideNode has.
template <int kWidth, typename Node>
[[gnu::always_inline]] inline void half_areas(const Node& node, float* areas) {
  for (int group = 0; group < kWidth; group += 4) {
    const auto extent = [&](int axis) { return load4(node.planes[axis][1] + group) - load4(node.planes[axis][0] + group); };
    const Float4 x = extent(0);
    const Float4 y = extent(1);
    const Float4 z = extent(2);
    const Float4 half_area = x * y + y * z + z * x;
    __builtin_memcpy(areas + group, &half_area, sizeof half_area);
  }
}

/// A child that waits on a stack, and from which distance on the ray may hit something in it.
template <typename Child>
struct WaitingChild {
  Child child;
  float t;
};

/// Pushes those of a node's children that are met, by the bits of `met`, the nearest on top: by insertion, as mostly there are one or two. pushes(child) is told
/// of each.
template <typename Child, typename Pushes>
[[gnu::always_inline]] inline void push_near_to_far(const Child* children, unsigned met, const float* entry, WaitingChild<Child>* stack,
                                                    std::uint32_t& stack_size, const Pushes& pushes) {
  const std::uint32_t bottom = stack_size;
  for (; met != 0; met &= met - 1) {
    const int i = std::countr_zero(met);
    pushes(children[i]);
    std::uint32_t place = stack_size++;
    for (; place > bottom && stack[place - 1].t < entry[i]; --place) stack[place] = stack[place - 1];
    stack[place] = {children[i], entry[i]};
  }
}

/// Walks the children that are leaves and that the ray meets, near to far or in large boxes first. leaf(child) returns whether the walk is over; it may lower what `t_max` refers to.
/// `Node` has `planes` as WideNode has, or tells boxes() that do, and children that know is_leaf() and node(). Node 0 must be there, and the ray traceable.
template <WalkOrder kOrder, typename Node, typename LeafTest, typename LeafPrefetch, typename C>
void walk_nodes(const Node* nodes, const Box& bounds, const Ray& ray, const float& t_max, const LeafTest& leaf,
                const LeafPrefetch& prefetch_leaf, C& counter) {
  using Child = std::remove_cvref_t<decltype(nodes->child[0])>;
  constexpr int kWidth = static_cast<int>(std::extent_v<decltype(nodes->child)>);
  // Each level leaves at most kWidth - 1 behind; a node above a single leaf may be one level more.
  WaitingChild<Child> stack[(kWidth - 1) * (Bvh2::kMaxDepth + 1) + kWidth];
  std::uint32_t stack_size = 0;
  const WideSlabs<kWidth> slabs(SlabRay(ray, bounds));
  const Float4 t_min = splat(ray.t_min > 0.0F ? ray.t_min : 0.0F);
  const Node* node = nodes;
  for (;;) {
    count_node(counter, static_cast<std::uint32_t>(node - nodes));
    float entry[kWidth];
    const auto& boxes = boxes_of(*node);
    const unsigned met = slabs.test(boxes, t_min, splat(t_max), entry);
    if constexpr (kOrder == WalkOrder::largest_first) {
      // Instead of distances, which are of no use where the first hit ends the walk.
      half_areas<kWidth>(boxes, entry);
      for (float& area : entry) area = -area;
    }
    push_near_to_far(node->child, met, entry, stack, stack_size, [&](Child child) {
      if (child.is_leaf()) return prefetch_leaf(child);
      const char* const line = reinterpret_cast<const char*>(nodes + child.node());
      for (std::size_t offset = 0; offset < sizeof(Node); offset += 64) __builtin_prefetch(line + offset);
    });
    counter.reach_stack_depth(stack_size);
    for (;;) {
      // A tie must still be visited: the primitive there may have a lower id.
      do {
        if (stack_size == 0) return;
        --stack_size;
      } while (stack[stack_size].t > t_max);
      const Child next = stack[stack_size].child;
      if (!next.is_leaf()) {
        node = nodes + next.node();
        break;
      }
      count_leaf(counter, leaf_number(next));
      if (leaf(next)) return;
    }
  }
}

/// Walks the leaves that the ray meets; the contract is that of the walk through a Bvh2.
template <WalkOrder kOrder, int kWidth, typename LeafTest, typename LeafPrefetch, typename C>
void walk(const WideBvh<kWidth>& bvh, const Ray& ray, const float& t_max, const LeafTest& leaf, const LeafPrefetch& prefetch_leaf,
          C& counter) {
  if (bvh.references.empty()) return;
  if (bvh.nodes.empty()) {
    count_leaf(counter, 0);
    leaf(0U, static_cast<std::uint32_t>(bvh.references.size()));
    return;
  }
  using Child = typename WideNode<kWidth>::Child;
  walk_nodes<kOrder>(
      bvh.nodes.data(), bvh.bounds, ray, t_max, [&](Child child) { return leaf(child.first, child.count); },
      [&](Child child) { prefetch_leaf(child.first); }, counter);
}

}  // namespace grove
