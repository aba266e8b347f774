// The quick test of a block of triangles (Möller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997): all distances and places at once in floats.
// Not watertight: rays through an edge may miss both triangles. No step is fused, so results are the same on every instruction set. Included once for each
// of them.

#if defined(GROVE_BLOCK_HITS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_BLOCK_HITS_INL_H
#undef GROVE_BLOCK_HITS_INL_H
#else
#define GROVE_BLOCK_HITS_INL_H
#endif

#include <hwy/highway.h>

#include <bit>
#include <limits>

#include "grove/accel/fast_block.h"
#include "grove/geometry/hit.h"
#include "grove/traverse/simd/batch_ray.h"
#include "grove/traverse/simd/compaction-inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// The hits of a block that are in range, by place.
struct FourHits {
  std::uint32_t places = 0;  // bits
  float t[TriangleBlock::kWidth];
  float u[TriangleBlock::kWidth];
  float v[TriangleBlock::kWidth];
};

template <typename V>
HWY_INLINE void cross3(const V a[3], const V b[3], V product[3]) {
  product[0] = hn::Sub(hn::Mul(a[1], b[2]), hn::Mul(a[2], b[1]));
  product[1] = hn::Sub(hn::Mul(a[2], b[0]), hn::Mul(a[0], b[2]));
  product[2] = hn::Sub(hn::Mul(a[0], b[1]), hn::Mul(a[1], b[0]));
}

template <typename V>
HWY_INLINE V inner3(const V a[3], const V b[3]) {
  return hn::Add(hn::Add(hn::Mul(a[0], b[0]), hn::Mul(a[1], b[1])), hn::Mul(a[2], b[2]));
}

HWY_INLINE void test_block(const BatchRay& ray, float t_max, const TriangleBlock& block, FourHits& hits) {
  const hn::CappedTag<float, TriangleBlock::kWidth> d;
  using V = hn::Vec<decltype(d)>;
  const std::uint32_t axes[3] = {ray.axes.kx, ray.axes.ky, ray.axes.kz};
  for (std::size_t first = 0; first < TriangleBlock::kWidth; first += hn::MaxLanes(d)) {
    V edge1[3];
    V edge2[3];
    V from[3];  // the first corner to the origin
    V direction[3];
    for (int axis = 0; axis < 3; ++axis) {
      const auto& corner = block.corners[axes[axis]];
      const V corner0 = hn::LoadU(d, corner[0] + first);
      edge1[axis] = hn::Sub(hn::LoadU(d, corner[1] + first), corner0);
      edge2[axis] = hn::Sub(hn::LoadU(d, corner[2] + first), corner0);
      from[axis] = hn::Neg(hn::Add(corner0, hn::Set(d, ray.minus_origin_k[axis])));
      direction[axis] = hn::Set(d, ray.direction_k[axis]);
    }
    V p[3];
    V q[3];
    cross3(direction, edge2, p);
    cross3(from, edge1, q);
    const V inverse = hn::Div(hn::Set(d, 1.0F), inner3(edge1, p));
    const V u = hn::Mul(inner3(from, p), inverse);
    const V v = hn::Mul(inner3(direction, q), inverse);
    const V t = hn::Mul(inner3(edge2, q), inverse);
    // A triangle seen edge-on has a NaN or an infinity here, which fails.
    const auto inside = hn::And(hn::Ge(hn::Min(u, v), hn::Zero(d)), hn::Le(hn::Add(u, v), hn::Set(d, 1.0F)));
    const auto in_range = hn::And(hn::And(hn::Ge(t, hn::Set(d, ray.t_min)), hn::Le(t, hn::Set(d, t_max))),
                                  hn::Lt(t, hn::Set(d, std::numeric_limits<float>::infinity())));
    hits.places |= bits_of(d, hn::And(inside, in_range)) << first;
    hn::StoreU(t, d, hits.t + first);
    hn::StoreU(u, d, hits.u + first);
    hn::StoreU(v, d, hits.v + first);
  }
}

struct AcceptsAll {
  HWY_INLINE bool operator()(const Hit& /*hit*/) const { return true; }
};

// Takes the closest of hits where it is closer than `hit`, as hits are compared everywhere, and accepts(hit) says that it counts.
template <typename Accepts>
HWY_INLINE void take_closest(const FourHits& hits, const TriangleBlock& block, Hit& hit, const Accepts& accepts) {
  for (std::uint32_t left = hits.places; left != 0; left &= left - 1) {
    const int place = std::countr_zero(left);
    if (!is_closer(hits.t[place], block.primitive[place], hit)) continue;
    Hit closer;
    closer.t = hits.t[place];
    closer.u = hits.u[place];
    closer.v = hits.v[place];
    closer.primitive = block.primitive[place];
    if (accepts(closer)) hit = closer;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace grove
HWY_AFTER_NAMESPACE();

#endif
