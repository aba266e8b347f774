#pragma once

// One ray through the hierarchy of the fast path, without wide registers: for rays on their own, and for those whose numbers the batch kernel
// (simd/fast_batch.h) does not take.

#include <bit>
#include <cstdint>

#include "grove/accel/fast_bvh.h"
#include "grove/geometry/watertight_triangle.h"
#include "grove/traverse/wide_traversal.h"

namespace grove {

/// Triangle `place` of a block.
[[nodiscard]] inline SingleTriangle triangle_in(const TriangleBlock& block, std::uint32_t place) {
  const auto corner = [&](int i) { return Vec3(block.corners[0][i][place], block.corners[1][i][place], block.corners[2][i][place]); };
  return {corner(0), corner(1), corner(2)};
}

/// Bit i: the ray does not pass outside of an edge of triangle i, by the float arithmetic of the watertight test. Those are worth that test.
[[nodiscard]] inline unsigned inside_edges(const TriangleBlock& block, const WatertightRay& ray) {
  Float4 x[3];
  Float4 y[3];
  for (int corner = 0; corner < 3; ++corner) {
    const Float4 z = load4(block.corners[ray.kz][corner]) - ray.origin_z;
    x[corner] = (load4(block.corners[ray.kx][corner]) - ray.origin_x) - ray.shear_x * z;
    y[corner] = (load4(block.corners[ray.ky][corner]) - ray.origin_y) - ray.shear_y * z;
  }
  const Float4 a = x[2] * y[1] - y[2] * x[1];
  const Float4 b = x[0] * y[2] - y[0] * x[2];
  const Float4 c = x[1] * y[0] - y[1] * x[0];
  // Where one is NaN the others decide, or nothing does.
  const Int4 outside = (min(min(a, b), c) < Float4{}) & (max(max(a, b), c) > Float4{});
  return ~static_cast<unsigned>(four_lanes(outside)) & 0xfU;
}

/// All lines of a node, or of a block.
inline void prefetch(const FastBvh& bvh, FastChild child) {
  const char* const line = child.is_leaf() ? reinterpret_cast<const char*>(bvh.blocks.data() + child.block())
                                           : reinterpret_cast<const char*>(bvh.nodes.data() + child.node());
  for (int offset = 0; offset < 256; offset += 64) __builtin_prefetch(line + offset);
}

/// Walks the leaves that the ray meets, near to far. leaf(block, count) tests a block and returns whether the walk is over; it may lower what
/// `t_max` refers to. The ray must be traceable.
template <typename LeafTest, typename C>
void walk_fast(const FastBvh& bvh, const Ray& ray, const float& t_max, const LeafTest& leaf, C& counter) {
  if (bvh.nodes.empty()) return;
  struct Entry {
    FastChild child;
    float t;
  };
  constexpr int kWidth = FastNode::kWidth;
  // Each level leaves at most kWidth - 1 behind.
  Entry stack[(kWidth - 1) * (Bvh2::kMaxDepth + 1) + kWidth];
  std::uint32_t stack_size = 0;
  const WideSlabs<kWidth> slabs(SlabRay(ray, bvh.bounds));
  const Float4 t_min = splat(ray.t_min > 0.0F ? ray.t_min : 0.0F);
  FastChild next = FastChild::node(0);
  for (;;) {
    if (next.is_leaf()) {
      counter.enter_leaf();
      if (leaf(bvh.blocks[next.block()], next.count())) return;
    } else {
      const FastNode& node = bvh.nodes[next.node()];
      counter.visit_node();
      float entry[kWidth];
      unsigned met = slabs.test(node, t_min, splat(t_max), entry);
      const std::uint32_t bottom = stack_size;
      for (; met != 0; met &= met - 1) {
        const int i = std::countr_zero(met);
        prefetch(bvh, node.child[i]);
        // Insertion by distance, the nearest on top; mostly there are one or two.
        std::uint32_t place = stack_size++;
        for (; place > bottom && stack[place - 1].t < entry[i]; --place) stack[place] = stack[place - 1];
        stack[place] = {node.child[i], entry[i]};
      }
      counter.reach_stack_depth(stack_size);
    }
    // A tie must still be visited: the primitive there may have a lower id.
    do {
      if (stack_size == 0) return;
      --stack_size;
    } while (stack[stack_size].t > t_max);
    next = stack[stack_size].child;
  }
}

/// Closest hit. `hit.t` must start as the ray's t_max.
template <typename C>
void trace_closest(const FastBvh& bvh, const Ray& ray, Hit& hit, C& counter) {
  const WatertightRay prepared(ray);
  const auto test_leaf = [&](const TriangleBlock& block, std::uint32_t count) {
    for (std::uint32_t place = 0; place < count; ++place) counter.test_primitive();
    for (unsigned left = inside_edges(block, prepared) & ((1U << count) - 1); left != 0; left &= left - 1) {
      const auto place = static_cast<std::uint32_t>(std::countr_zero(left));
      intersect_watertight(prepared, triangle_in(block, place).corners, &block.primitive[place], hit);
    }
    return false;
  };
  walk_fast(bvh, ray, hit.t, test_leaf, counter);
}

/// Any hit within [ray.t_min, ray.t_max].
template <typename C>
bool trace_any(const FastBvh& bvh, const Ray& ray, C& counter) {
  const WatertightRay prepared(ray);
  bool found = false;
  const auto test_leaf = [&](const TriangleBlock& block, std::uint32_t count) {
    for (std::uint32_t place = 0; place < count; ++place) counter.test_primitive();
    for (unsigned left = inside_edges(block, prepared) & ((1U << count) - 1); left != 0 && !found; left &= left - 1) {
      const auto place = static_cast<std::uint32_t>(std::countr_zero(left));
      found = occluded_watertight(prepared, triangle_in(block, place).corners);
    }
    return found;
  };
  walk_fast(bvh, ray, ray.t_max, test_leaf, counter);
  return found;
}

}  // namespace grove
