#pragma once

// Ordered depth-first traversal of a binary hierarchy: both children of a node are tested at once in one register, the nearer is
// entered, the farther waits on a stack with its distance and is dropped at pop when a closer hit has been found since.

#include <cstdint>

#include "grove/accel/bvh2.h"
#include "grove/geometry/geometry_concept.h"
#include "grove/math/float4.h"
#include "grove/traverse/slab_ray.h"

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
  int test(const Bvh2Node& node, Float4 limits, float entry[2]) const {
    // max(a, b) is b when a is NaN: a ray inside a plane is not limited by it.
    Float4 t = max((planes(node, 0) - origin_[0]) * inverse_[0], limits);
    t = max((planes(node, 1) - origin_[1]) * inverse_[1], t);
    t = max((planes(node, 2) - origin_[2]) * inverse_[2], t);
    const Float4 exits = -t;
    entry[0] = t[0];
    entry[1] = t[1];
    return static_cast<int>(t[0] <= exits[2]) | (static_cast<int>(t[1] <= exits[3]) << 1);
  }

 private:
  [[nodiscard]] Float4 planes(const Bvh2Node& node, int axis) const {
    Float4 result;
    const float* row = node.planes[axis];
    std::memcpy(&result, row + near_[axis], 2 * sizeof(float));
    std::memcpy(reinterpret_cast<char*>(&result) + 2 * sizeof(float), row + (2 - near_[axis]), 2 * sizeof(float));
    return result;
  }

  Float4 origin_[3];
  Float4 inverse_[3];
  std::int64_t near_[3];
};

/// Walks the leaves that the ray meets, near to far as far as the boxes tell. `leaf(first, count)` tests references, may lower `t_max`,
/// and returns true to end the walk. `ray` must be traceable.
template <typename LeafTest, typename C>
void walk(const Bvh2& bvh, const Ray& ray, const float& t_max, const LeafTest& leaf, C& counter) {
  if (bvh.references.empty()) return;
  if (bvh.nodes.empty()) {
    counter.enter_leaf();
    leaf(0U, static_cast<std::uint32_t>(bvh.references.size()));
    return;
  }
  struct Entry {
    std::uint32_t first, count;
    float t;
  };
  Entry stack[Bvh2::kMaxDepth + 1];
  std::uint32_t stack_size = 0;
  const Bvh2Slabs slabs(SlabRay(ray, bvh.bounds));
  const float t_min = ray.t_min > 0.0F ? ray.t_min : 0.0F;
  Float4 limits{t_min, t_min, -t_max, -t_max};
  const Bvh2Node* const nodes = bvh.nodes.data();
  std::uint32_t current = 0;
  for (;;) {
    const Bvh2Node& node = nodes[current];
    counter.visit_node();
    float entry[2];
    const int met = slabs.test(node, limits, entry);
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    bool have_next = true;
    if (met == 3) {
      const int nearer = entry[1] < entry[0] ? 1 : 0;
      stack[stack_size++] = {node.first[1 - nearer], node.count[1 - nearer], entry[1 - nearer]};
      counter.reach_stack_depth(stack_size);
      first = node.first[nearer];
      count = node.count[nearer];
    } else if (met != 0) {
      first = node.first[met - 1];
      count = node.count[met - 1];
    } else {
      have_next = false;
    }
    for (;;) {
      if (have_next) {
        if (count == 0) break;
        counter.enter_leaf();
        if (leaf(first, count)) return;
        limits = Float4{t_min, t_min, -t_max, -t_max};
      }
      // A tie must still be visited: the primitive there may have a lower id.
      do {
        if (stack_size == 0) return;
        --stack_size;
      } while (stack[stack_size].t > t_max);
      first = stack[stack_size].first;
      count = stack[stack_size].count;
      have_next = true;
    }
    current = first;
  }
}

/// Closest hit. `hit.t` must start as the ray's t_max.
template <Geometry G, typename C>
void trace_closest(const Bvh2& bvh, const G& geometry, const Ray& ray, Hit& hit, C& counter) {
  const typename G::PreparedRay prepared = geometry.prepare(ray);
  const auto test_leaf = [&](std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t i = first; i < first + count; ++i) {
      counter.test_primitive();
      geometry.intersect(bvh.references[i], prepared, hit, counter);
    }
    return false;
  };
  walk(bvh, ray, hit.t, test_leaf, counter);
}

/// Any hit within [ray.t_min, ray.t_max].
template <Geometry G, typename C>
bool trace_any(const Bvh2& bvh, const G& geometry, const Ray& ray, C& counter) {
  const typename G::PreparedRay prepared = geometry.prepare(ray);
  bool found = false;
  const auto test_leaf = [&](std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t i = first; i < first + count && !found; ++i) {
      counter.test_primitive();
      found = geometry.occluded(bvh.references[i], prepared, counter);
    }
    return found;
  };
  walk(bvh, ray, ray.t_max, test_leaf, counter);
  return found;
}

}  // namespace grove
