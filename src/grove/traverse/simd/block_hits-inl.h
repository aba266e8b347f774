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
#include "grove/traverse/simd/block_test-inl.h"
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

// The hits of pairs of a ray and a triangle, within [t_min, t_max].
template <typename D>
struct FloatHits {
  hn::Vec<D> t, u, v;
  hn::Mask<D> mask;
};

template <typename D, typename V = hn::Vec<D>>
HWY_INLINE FloatHits<D> test_pairs(D d, const RayTrianglePairs<V>& pairs, V t_min, V t_max) {
  V edge1[3];
  V edge2[3];
  V from[3];  // the first corner to the origin
  for (int axis = 0; axis < 3; ++axis) {
    const V corner0 = pairs.corner[axis][0];
    edge1[axis] = hn::Sub(pairs.corner[axis][1], corner0);
    edge2[axis] = hn::Sub(pairs.corner[axis][2], corner0);
    from[axis] = hn::Neg(hn::Add(corner0, pairs.minus_origin[axis]));
  }
  V p[3];
  V q[3];
  cross3(pairs.direction, edge2, p);
  cross3(from, edge1, q);
  const V inverse = hn::Div(hn::Set(d, 1.0F), inner3(edge1, p));
  FloatHits<D> hits;
  hits.u = hn::Mul(inner3(from, p), inverse);
  hits.v = hn::Mul(inner3(pairs.direction, q), inverse);
  hits.t = hn::Mul(inner3(edge2, q), inverse);
  // A triangle seen edge-on has a NaN or an infinity here, which fails.
  const auto inside = hn::And(hn::Ge(hn::Min(hits.u, hits.v), hn::Zero(d)), hn::Le(hn::Add(hits.u, hits.v), hn::Set(d, 1.0F)));
  const auto in_range =
      hn::And(hn::And(hn::Ge(hits.t, t_min), hn::Le(hits.t, t_max)), hn::Lt(hits.t, hn::Set(d, std::numeric_limits<float>::infinity())));
  hits.mask = hn::And(inside, in_range);
  return hits;
}

HWY_INLINE void test_block(const BatchRay& ray, float t_max, const TriangleBlock& block, FourHits& hits) {
  const hn::CappedTag<float, TriangleBlock::kWidth> d;
  RayTrianglePairs<hn::Vec<decltype(d)>> pairs;
  set_ray(ray, pairs);
  for (std::size_t first = 0; first < TriangleBlock::kWidth; first += hn::MaxLanes(d)) {
    set_corners(ray.axes, block, first, pairs);
    const auto some = test_pairs(d, pairs, hn::Set(d, ray.t_min), hn::Set(d, t_max));
    hits.places |= bits_of(d, some.mask) << first;
    hn::StoreU(some.t, d, hits.t + first);
    hn::StoreU(some.u, d, hits.u + first);
    hn::StoreU(some.v, d, hits.v + first);
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
