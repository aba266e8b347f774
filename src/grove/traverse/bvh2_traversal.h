#pragma once

// Ordered depth-first traversal of a binary hierarchy: both children of a node are tested at once in one register, the nearer is
// entered, the farther waits on a stack with its distance and is dropped at pop when a closer hit has been found since. A search for any hit enters the
// larger.

#include <cstdint>

#include "grove/accel/bvh2.h"
#include "grove/geometry/geometry_concept.h"
#include "grove/math/float4.h"
#include "grove/traverse/slab_ray.h"
#include "grove/traverse/traversal_record.h"
#include "grove/traverse/walk_order.h"

namespace grove {

/// The two box tests of a node for one ray. Lanes 0 and 1 hold the near planes of the children, 2 and 3 the far planes with the sign
/// turned over, so that both the latest entry and the earliest exit are maxima.
class Bvh2Slabs {
 public:
  explicit Bvh2Slabs(const SlabRay& ray) {
    for (int axis = 0; axis < 3; ++axis) {
      origin_[axis] = Float4{ray.origin_near[axis], ray.origin_near[axis], ray.origin_far[axis], ray.origin_far[axis]};
      inverse_[axis] = Float4{ray.inverse_near[axis], ray.inverse_near[axis], -ray.inverse_far[axis], -ray.inverse_far[axis]};
      near_[axis] = ray.negative[axis] ? 2 : 0;
    }
  }

  /// Entry distances of both children; a child that the ray misses within `limits` has its bit unset in the result.
  /// `limits` is {t_min, t_min, -t_max, -t_max}.
  [[gnu::always_inline]] int test(const Bvh2Node& node, Float4 limits, float entry[2]) const {
    // max(a, b) is b when a is NaN: a ray inside a plane is not limited by it.
    Float4 t = max((planes(node, 0) - origin_[0]) * inverse_[0], limits);
    t = max((planes(node, 1) - origin_[1]) * inverse_[1], t);
    t = max((planes(node, 2) - origin_[2]) * inverse_[2], t);
    entry[0] = t[0];
    entry[1] = t[1];
    const Float4 exits = -__builtin_shufflevector(t, t, 2, 3, 2, 3);
    return first_two_lanes(t <= exits);
  }

 private:
  // Two loads of two planes each, put together as doubles: a register is filled without a way through memory.
  [[nodiscard, gnu::always_inline]] Float4 planes(const Bvh2Node& node, int axis) const {
    using Double2 = double __attribute__((vector_size(16)));
    const float* row = node.planes[axis];
    double near;
    double far;
    std::memcpy(&near, row + near_[axis], sizeof near);
    std::memcpy(&far, row + 2 - near_[axis], sizeof far);
    return reinterpret_cast<Float4>(Double2{near, far});
  }

  Float4 origin_[3];
  Float4 inverse_[3];
  std::int64_t near_[3];
};

/// Whether the box of a node's second child has the larger surface.
[[nodiscard, gnu::always_inline]] inline bool is_second_larger(const Bvh2Node& node) {
  const auto extent = [&](int axis) {
    const Float4 planes = load4(node.planes[axis]);
    return __builtin_shufflevector(planes, planes, 2, 3, 2, 3) - planes;
  };
  const Float4 x = extent(0);
  const Float4 y = extent(1);
  const Float4 z = extent(2);
  const Float4 half_area = x * y + y * z + z * x;
  return half_area[1] > half_area[0];
}

/// Walks the leaves that the ray meets, near to far as far as the boxes tell, or in large boxes first. `leaf(first, count)` tests references, may lower `t_max`,
/// and returns true to end the walk; `prefetch_leaf(first)` asks for a leaf that may be next. `ray` must be traceable.
template <WalkOrder kOrder, typename LeafTest, typename LeafPrefetch, typename C>
void walk(const Bvh2& bvh, const Ray& ray, const float& t_max, const LeafTest& leaf, const LeafPrefetch& prefetch_leaf, C& counter) {
  if (bvh.references.empty()) return;
  if (bvh.nodes.empty()) {
    count_leaf(counter, 0);
    leaf(0U, static_cast<std::uint32_t>(bvh.references.size()));
    return;
  }
  struct Entry {
    Bvh2Node::Child child;
    float t;
  };
  Entry stack[Bvh2::kMaxDepth + 1];
  std::uint32_t stack_size = 0;
  const Bvh2Slabs slabs(SlabRay(ray, bvh.bounds));
  const float t_min = ray.t_min > 0.0F ? ray.t_min : 0.0F;
  Float4 limits{t_min, t_min, -t_max, -t_max};
  const Bvh2Node* const nodes = bvh.nodes.data();
  Bvh2Node::Child next{0, 0};
  for (;;) {
    const Bvh2Node& node = nodes[next.first];
    count_node(counter, next.first);
    // Either child may be next.
    for (const Bvh2Node::Child& child : node.child) {
      if (child.count == 0) {
        __builtin_prefetch(nodes + child.first);
      } else {
        prefetch_leaf(child.first);
      }
    }
    float entry[2];
    const int met = slabs.test(node, limits, entry);
    // Branches rather than selects: a guess lets the next node's load start before this one's test is done.
    if (met == 3) {
      if (kOrder == WalkOrder::nearest_first ? entry[1] < entry[0] : is_second_larger(node)) {
        stack[stack_size++] = {node.child[0], entry[0]};
        next = node.child[1];
      } else {
        stack[stack_size++] = {node.child[1], entry[1]};
        next = node.child[0];
      }
      counter.reach_stack_depth(stack_size);
    } else if (met == 1) {
      next = node.child[0];
    } else if (met == 2) {
      next = node.child[1];
    }
    bool pending = met != 0;
    while (!pending || next.count > 0) {
      if (pending) {
        count_leaf(counter, next.first);
        if (leaf(next.first, next.count)) return;
        limits = Float4{t_min, t_min, -t_max, -t_max};
      }
      // A tie must still be visited: the primitive there may have a lower id.
      do {
        if (stack_size == 0) return;
        --stack_size;
      } while (stack[stack_size].t > t_max);
      next = stack[stack_size].child;
      pending = true;
    }
  }
}

}  // namespace grove
