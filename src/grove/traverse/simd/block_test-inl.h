// The watertight test of watertight_triangle.h in two parts: which of a block's four triangles a ray may hit, and where rays hit such triangles, several
// pairs at once. The operations are the same in the same order, so that results are the same, bit for bit. What is rare is left to that test: edge
// functions that come out zero or out of range, and distances that need its second look. Included once for each instruction set.

#if defined(GROVE_BLOCK_TEST_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_BLOCK_TEST_INL_H
#undef GROVE_BLOCK_TEST_INL_H
#else
#define GROVE_BLOCK_TEST_INL_H
#endif

#include <hwy/highway.h>

#include "grove/accel/fast_bvh.h"
#include "grove/traverse/simd/batch_ray.h"
#include "grove/traverse/simd/compaction-inl.h"
#include "grove/traverse/simd/hit_candidates.h"

HWY_BEFORE_NAMESPACE();
namespace grove {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Corners as rays see them: several triangles and one ray, or one triangle and several rays.
template <typename V>
struct ShearedCorners {
  V x[3];
  V y[3];
  V z[3];

  // Of a corner along the axes of the ray, relative to its origin.
  HWY_INLINE void set(int corner, V along_x, V along_y, V along_z, V shear_x, V shear_y) {
    z[corner] = along_z;
    x[corner] = hn::Sub(along_x, hn::Mul(shear_x, along_z));
    y[corner] = hn::Sub(along_y, hn::Mul(shear_y, along_z));
  }
};

// The edge function of corners i and j.
template <typename V>
HWY_INLINE V edge_function(const ShearedCorners<V>& corners, int i, int j) {
  return hn::Sub(hn::Mul(corners.x[i], corners.y[j]), hn::Mul(corners.y[i], corners.x[j]));
}

template <typename V>
HWY_INLINE V dot3(const V a[3], const V b[3]) {
  return hn::Add(hn::Add(hn::Mul(a[0], b[0]), hn::Mul(a[1], b[1])), hn::Mul(a[2], b[2]));
}

// Bit i of `possible`: pair i of a ray and a triangle may be a hit, as the ray does not pass outside of an edge, nor is the triangle too far away or too near.
// Bit i of `certain`: it is one, wherever between the corners. (That is told for any hit only.)
struct BlockFilter {
  std::uint32_t possible = 0;
  std::uint32_t certain = 0;
};

template <bool kTellCertain, typename D, typename V = hn::Vec<D>>
HWY_INLINE BlockFilter filter_sheared(D d, const ShearedCorners<V>& corners, V inverse_z, V depth_pad, V nearest, V farthest) {
  const V edge[3] = {edge_function(corners, 2, 1), edge_function(corners, 0, 2), edge_function(corners, 1, 0)};
  const V t[3] = {hn::Mul(corners.z[0], inverse_z), hn::Mul(corners.z[1], inverse_z), hn::Mul(corners.z[2], inverse_z)};
  const V zero = hn::Zero(d);
  const V least_t = hn::Sub(hn::Min(hn::Min(t[0], t[1]), t[2]), depth_pad);
  const V most_t = hn::Add(hn::Max(hn::Max(t[0], t[1]), t[2]), depth_pad);
  const V least_edge = hn::Min(hn::Min(edge[0], edge[1]), edge[2]);
  const V most_edge = hn::Max(hn::Max(edge[0], edge[1]), edge[2]);
  const auto in_range = hn::And(hn::Le(least_t, farthest), hn::Ge(most_t, nearest));
  const auto inside = hn::Or(hn::Ge(least_edge, zero), hn::Le(most_edge, zero));
  BlockFilter filter;
  filter.possible = bits_of(d, hn::And(in_range, inside));
  if constexpr (kTellCertain) {
    const auto surely_in_range = hn::And(hn::Ge(least_t, nearest), hn::Le(most_t, farthest));
    // Far from where the watertight test would ask doubles.
    const V tiny = hn::Set(d, 1e-30F);
    const auto surely_inside = hn::Or(hn::Gt(least_edge, tiny), hn::Lt(most_edge, hn::Neg(tiny)));
    const auto finite = hn::Lt(most_t, hn::Set(d, std::numeric_limits<float>::infinity()));
    filter.certain = bits_of(d, hn::And(hn::And(surely_in_range, finite), surely_inside));
  }
  return filter;
}

// Of a block's triangles for a ray.
template <bool kTellCertain>
HWY_INLINE BlockFilter filter_block(const BatchRay& ray, float t_max, const TriangleBlock& block) {
  const hn::CappedTag<float, TriangleBlock::kWidth> d;
  BlockFilter filter;
  for (std::size_t first = 0; first < TriangleBlock::kWidth; first += hn::MaxLanes(d)) {
    const auto along = [&](std::uint32_t axis, int corner, float minus_origin) {
      return hn::Add(hn::LoadU(d, block.corners[axis][corner] + first), hn::Set(d, minus_origin));
    };
    ShearedCorners<hn::Vec<decltype(d)>> corners;
    for (int corner = 0; corner < 3; ++corner) {
      corners.set(corner, along(ray.axes.kx, corner, ray.minus_origin_k[0]), along(ray.axes.ky, corner, ray.minus_origin_k[1]),
                  along(ray.axes.kz, corner, ray.minus_origin_k[2]), hn::Set(d, ray.shear_x), hn::Set(d, ray.shear_y));
    }
    const BlockFilter some = filter_sheared<kTellCertain>(d, corners, hn::Set(d, ray.inverse_z), hn::Set(d, ray.depth_pad),
                                                          hn::Set(d, ray.t_min), hn::Set(d, t_max));
    filter.possible |= some.possible << first;
    filter.certain |= some.certain << first;
  }
  return filter;
}

// Pairs of a ray and a triangle, along the axes kx, ky, kz of the rays.
template <typename F>
struct RayTrianglePairs {
  F corner[3][3];  // by axis and corner
  F minus_origin[3];
  F direction[3];
  F shear[2];
};

// The ray of a block's triangles, in all lanes.
template <typename F>
HWY_INLINE void set_ray(const BatchRay& ray, RayTrianglePairs<F>& pairs) {
  const hn::DFromV<F> d;
  for (int axis = 0; axis < 3; ++axis) {
    pairs.minus_origin[axis] = hn::Set(d, ray.minus_origin_k[axis]);
    pairs.direction[axis] = hn::Set(d, ray.direction_k[axis]);
  }
  pairs.shear[0] = hn::Set(d, ray.shear_x);
  pairs.shear[1] = hn::Set(d, ray.shear_y);
}

// The block's triangles from number `first` on.
template <typename F>
HWY_INLINE void set_corners(const RayAxes& axes, const TriangleBlock& block, std::size_t first, RayTrianglePairs<F>& pairs) {
  const hn::DFromV<F> d;
  const std::uint32_t along[3] = {axes.kx, axes.ky, axes.kz};
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i < 3; ++i) pairs.corner[axis][i] = hn::LoadU(d, block.corners[along[axis]][i] + first);
}

// Where they meet.
template <typename F>
struct MeasuredHits {
  F t;
  F weights[3];             // of the corners, not normalised
  std::uint32_t known = 0;  // a bit for each pair; the others are left to the test of single triangles
};

// For pairs whose edge functions do not differ in sign; for others the results mean nothing.
template <typename DD, typename DF = hn::Rebind<float, DD>, typename F = hn::Vec<DF>>
HWY_INLINE MeasuredHits<F> measure(DD dd, const RayTrianglePairs<F>& pairs) {
  using D = hn::Vec<DD>;
  const DF df;
  // By axis and corner: relative to the origin in doubles, and as the ray sees them in floats.
  D corner[3][3];
  ShearedCorners<F> sheared;
  for (int i = 0; i < 3; ++i) {
    F along[3];
    for (int axis = 0; axis < 3; ++axis) {
      along[axis] = hn::Add(pairs.corner[axis][i], pairs.minus_origin[axis]);
      corner[axis][i] = hn::Add(hn::PromoteTo(dd, pairs.corner[axis][i]), hn::PromoteTo(dd, pairs.minus_origin[axis]));
    }
    sheared.set(i, along[0], along[1], along[2], pairs.shear[0], pairs.shear[1]);
  }
  const F edge[3] = {edge_function(sheared, 2, 1), edge_function(sheared, 0, 2), edge_function(sheared, 1, 0)};
  MeasuredHits<F> hits;
  for (int i = 0; i < 3; ++i) hits.weights[i] = hn::Abs(edge[i]);
  const F magnitude = hn::Abs(hn::Add(hn::Add(edge[0], edge[1]), edge[2]));
  const F least_weight = hn::Min(hn::Min(hits.weights[0], hits.weights[1]), hits.weights[2]);
  const auto in_range = hn::And(hn::Ge(magnitude, hn::Set(df, 1e-30F)), hn::Le(magnitude, hn::Set(df, std::numeric_limits<float>::max())));
  const auto is_regular = hn::And(hn::Gt(least_weight, hn::Zero(df)), in_range);

  D largest = hn::Zero(dd);
  D a[3];
  D b[3];
  D direction[3];
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < 3; ++i) largest = hn::Max(largest, hn::Abs(corner[axis][i]));
    a[axis] = hn::Sub(corner[axis][1], corner[axis][0]);
    b[axis] = hn::Sub(corner[axis][2], corner[axis][0]);
    direction[axis] = hn::PromoteTo(dd, pairs.direction[axis]);
  }
  const D first_corner[3] = {corner[0][0], corner[1][0], corner[2][0]};
  const D normal[3] = {hn::Sub(hn::Mul(a[1], b[2]), hn::Mul(b[1], a[2])), hn::Sub(hn::Mul(a[2], b[0]), hn::Mul(b[2], a[0])),
                       hn::Sub(hn::Mul(a[0], b[1]), hn::Mul(b[0], a[1]))};
  const D plane_t = hn::Div(dot3(normal, first_corner), dot3(normal, direction));
  const D plane_depth = hn::Mul(plane_t, direction[2]);

  D exact[3][3];
  for (int i = 0; i < 3; ++i) {
    exact[0][i] = hn::PromoteTo(dd, sheared.x[i]);
    exact[1][i] = hn::PromoteTo(dd, sheared.y[i]);
    exact[2][i] = hn::PromoteTo(dd, sheared.z[i]);
  }
  const auto weight = [&](int i, int j) { return hn::Sub(hn::Mul(exact[0][i], exact[1][j]), hn::Mul(exact[0][j], exact[1][i])); };
  const D edges[3] = {weight(2, 1), weight(0, 2), weight(1, 0)};
  const D sum = hn::Add(hn::Add(edges[0], edges[1]), edges[2]);
  const D tolerance = hn::Mul(hn::Set(dd, watertight::kDepthTolerance), largest);
  const auto agree = hn::Le(hn::Abs(hn::Sub(hn::Mul(plane_depth, sum), dot3(edges, exact[2]))), hn::Mul(tolerance, hn::Abs(sum)));

  hits.t = hn::DemoteTo(df, plane_t);
  hits.known = bits_of(df, is_regular) & bits_of(dd, agree);
  return hits;
}

// Tests all candidates: those whose edge functions do not differ in sign.
HWY_INLINE void test_candidates(HitCandidates& candidates) {
  candidates.fill_up();
  const hn::CappedTag<double, HitCandidates::kGroup> dd;
  const hn::Rebind<float, decltype(dd)> df;
  const hn::RebindToUnsigned<decltype(df)> du;
  using F = hn::Vec<decltype(df)>;
  std::uint64_t valid = 0;
  std::uint64_t known = 0;
  for (std::size_t first = 0; first < candidates.count; first += hn::MaxLanes(dd)) {
    RayTrianglePairs<F> pairs;
    for (int axis = 0; axis < 3; ++axis)
      for (int i = 0; i < 3; ++i) pairs.corner[axis][i] = hn::LoadU(df, candidates.corner[axis][i] + first);
    hn::LoadInterleaved4(df, candidates.minus_origin[first], pairs.minus_origin[0], pairs.minus_origin[1], pairs.minus_origin[2],
                         pairs.shear[0]);
    hn::LoadInterleaved4(df, candidates.direction[first], pairs.direction[0], pairs.direction[1], pairs.direction[2], pairs.shear[1]);
    const MeasuredHits<F> hits = measure(dd, pairs);
    const F sum = hn::Add(hn::Add(hits.weights[0], hits.weights[1]), hits.weights[2]);
    const F primitive = hn::BitCast(df, hn::LoadU(du, candidates.primitive + first));
    hn::StoreInterleaved4(hits.t, primitive, hn::Div(hits.weights[1], sum), hn::Div(hits.weights[2], sum), df, candidates.hit[first]);
    const auto in_range = hn::And(hn::Ge(hits.t, hn::LoadU(df, candidates.t_min + first)),
                                  hn::Lt(hits.t, hn::Set(df, std::numeric_limits<float>::infinity())));
    valid |= std::uint64_t{bits_of(df, in_range)} << first;
    known |= std::uint64_t{hits.known} << first;
  }
  const std::uint64_t all = candidates.count == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << candidates.count) - 1;
  static_assert(HitCandidates::kMost == 64);
  candidates.valid = valid & known & all;
  candidates.unknown = ~known & all;
}

// Measures a block's triangles for a ray.
struct MeasuredBlock {
  HWY_ALIGN float t[TriangleBlock::kWidth];
  HWY_ALIGN float weights[3][TriangleBlock::kWidth];
  std::uint32_t known = 0;
};

HWY_INLINE void measure_block(const BatchRay& ray, const TriangleBlock& block, MeasuredBlock& measured) {
  const hn::CappedTag<double, TriangleBlock::kWidth> dd;
  const hn::Rebind<float, decltype(dd)> df;
  RayTrianglePairs<hn::Vec<decltype(df)>> pairs;
  set_ray(ray, pairs);
  for (std::size_t first = 0; first < TriangleBlock::kWidth; first += hn::MaxLanes(dd)) {
    set_corners(ray.axes, block, first, pairs);
    const auto hits = measure(dd, pairs);
    hn::StoreU(hits.t, df, measured.t + first);
    for (int i = 0; i < 3; ++i) hn::StoreU(hits.weights[i], df, measured.weights[i] + first);
    measured.known |= hits.known << first;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace grove
HWY_AFTER_NAMESPACE();

#endif
