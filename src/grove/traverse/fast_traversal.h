#pragma once

// One ray through the hierarchy of the fast path, without wide registers: for rays on their own, and for those whose numbers the batch kernel
// (simd/fast_batch.h) does not take.

#include <bit>
#include <cstdint>

#include "grove/accel/fast_bvh.h"
#include "grove/geometry/hit_filter.h"
#include "grove/geometry/watertight_triangle.h"
#include "grove/traverse/walk_order.h"
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

/// A hierarchy of the fast path, and the vertices of its mesh for one whose blocks number them.
template <typename Bvh>
struct FastScene {
  const Bvh& bvh;
  const Vec3* vertices;
};

/// Walks the blocks that the ray meets in an order; otherwise as walk_nodes, of which leaf(block) is the leaf.
template <WalkOrder kOrder, typename Bvh, typename LeafTest, typename C>
void walk_blocks(const FastScene<Bvh>& scene, const Ray& ray, const float& t_max, const LeafTest& leaf, C& counter) {
  using Child = typename Bvh::Child;
  const Bvh& bvh = scene.bvh;
  if (bvh.empty()) return;
  const auto prefetch = [&](Child child) {
    const char* const line = reinterpret_cast<const char*>(bvh.units() + child.unit());
    for (std::size_t offset = 0; offset < sizeof(typename Bvh::Block); offset += 64) __builtin_prefetch(line + offset);
  };
  walk_nodes<kOrder>(
      bvh.nodes().data(), bvh.bounds, ray, t_max, [&](Child child) { return leaf(gathered(bvh.block(child), scene.vertices)); }, prefetch,
      counter);
}

/// A counter that counts nothing and asks a filter which knows triangles by their numbers in blocks, as kernels do.
class BlockFilterCounter : public NoCounter {
 public:
  explicit BlockFilterCounter(const HitFilter& filter) : filter_(filter) {}
  [[nodiscard]] bool accepts(const Hit& hit) const { return filter_(hit); }

 private:
  HitFilter filter_;
};

/// Closest hit. `hit.t` must start as the ray's t_max.
template <typename Bvh, typename C>
void trace_closest(const FastScene<Bvh>& scene, const Ray& ray, Hit& hit, C& counter) {
  const WatertightRay prepared(ray);
  const auto test_leaf = [&](const TriangleBlock& block) {
    const std::uint32_t count = block.count();
    for (std::uint32_t place = 0; place < count; ++place) count_test(counter, block.primitive[place]);
    for (unsigned left = inside_edges(block, prepared) & ((1U << count) - 1); left != 0; left &= left - 1) {
      const auto place = static_cast<std::uint32_t>(std::countr_zero(left));
      take_if_accepted(counter, hit, [&](Hit& taken) {
        return intersect_watertight(prepared, triangle_in(block, place).corners, &block.primitive[place], taken);
      });
    }
    return false;
  };
  walk_blocks<WalkOrder::nearest_first>(scene, ray, hit.t, test_leaf, counter);
}

/// Any hit within [ray.t_min, ray.t_max].
template <typename Bvh, typename C>
bool trace_any(const FastScene<Bvh>& scene, const Ray& ray, C& counter) {
  const WatertightRay prepared(ray);
  bool found = false;
  const auto test_leaf = [&](const TriangleBlock& block) {
    const std::uint32_t count = block.count();
    for (std::uint32_t place = 0; place < count; ++place) count_test(counter, block.primitive[place]);
    for (unsigned left = inside_edges(block, prepared) & ((1U << count) - 1); left != 0 && !found; left &= left - 1) {
      const auto place = static_cast<std::uint32_t>(std::countr_zero(left));
      if constexpr (FiltersHits<C>) {
        Hit hit;
        hit.t = ray.t_max;
        found = intersect_watertight(prepared, triangle_in(block, place).corners, &block.primitive[place], hit) && counter.accepts(hit);
      } else {
        found = occluded_watertight(prepared, triangle_in(block, place).corners);
      }
    }
    return found;
  };
  walk_blocks<WalkOrder::largest_first>(scene, ray, ray.t_max, test_leaf, counter);
  return found;
}

}  // namespace grove
