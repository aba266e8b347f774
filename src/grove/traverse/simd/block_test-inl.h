// The watertight test of watertight_triangle.h for one ray and the four triangles of a block, with the same operations in the same order, so that its
// results are the same, bit for bit. What is rare is left to that test: edge functions that come out zero or out of range, and distances that need
// its second look. Included once for each instruction set.

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

HWY_BEFORE_NAMESPACE();
namespace grove {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Corners as the ray sees them, and the edge functions.
template <typename D>
struct ShearedTriangles {
  using V = hn::Vec<D>;

  V x[3];
  V y[3];
  V z[3];
  V edge[3];

  HWY_INLINE ShearedTriangles(D d, const BatchRay& ray, const TriangleBlock& block, std::size_t first) {
    for (int corner = 0; corner < 3; ++corner) {
      z[corner] = hn::Sub(hn::LoadU(d, block.corners[ray.kz][corner] + first), hn::Set(d, ray.origin_k[2]));
      const V along_x = hn::Sub(hn::LoadU(d, block.corners[ray.kx][corner] + first), hn::Set(d, ray.origin_k[0]));
      const V along_y = hn::Sub(hn::LoadU(d, block.corners[ray.ky][corner] + first), hn::Set(d, ray.origin_k[1]));
      x[corner] = hn::Sub(along_x, hn::Mul(hn::Set(d, ray.shear_x), z[corner]));
      y[corner] = hn::Sub(along_y, hn::Mul(hn::Set(d, ray.shear_y), z[corner]));
    }
    edge[0] = hn::Sub(hn::Mul(x[2], y[1]), hn::Mul(y[2], x[1]));
    edge[1] = hn::Sub(hn::Mul(x[0], y[2]), hn::Mul(y[0], x[2]));
    edge[2] = hn::Sub(hn::Mul(x[1], y[0]), hn::Mul(y[1], x[0]));
  }
};

template <typename V>
HWY_INLINE V dot3(const V a[3], const V b[3]) {
  return hn::Add(hn::Add(hn::Mul(a[0], b[0]), hn::Mul(a[1], b[1])), hn::Mul(a[2], b[2]));
}

// Bit i: triangle i may be hit: the ray does not pass outside of an edge, nor farther away than t_max.
HWY_INLINE std::uint32_t filter_block(const BatchRay& ray, float t_max, const TriangleBlock& block) {
  const hn::CappedTag<float, TriangleBlock::kWidth> d;
  using V = hn::Vec<decltype(d)>;
  std::uint32_t missed = 0;
  for (std::size_t first = 0; first < TriangleBlock::kWidth; first += hn::MaxLanes(d)) {
    const ShearedTriangles<decltype(d)> triangles(d, ray, block, first);
    const V inverse_z = hn::Set(d, ray.inverse_z);
    const V t[3] = {hn::Mul(triangles.z[0], inverse_z), hn::Mul(triangles.z[1], inverse_z), hn::Mul(triangles.z[2], inverse_z)};
    const V zero = hn::Zero(d);
    const V least_edge = hn::Min(hn::Min(triangles.edge[0], triangles.edge[1]), triangles.edge[2]);
    const V most_edge = hn::Max(hn::Max(triangles.edge[0], triangles.edge[1]), triangles.edge[2]);
    const V pad = hn::Set(d, ray.depth_pad);
    const auto too_far = hn::Gt(hn::Sub(hn::Min(hn::Min(t[0], t[1]), t[2]), pad), hn::Set(d, t_max));
    const auto too_near = hn::Lt(hn::Add(hn::Max(hn::Max(t[0], t[1]), t[2]), pad), hn::Set(d, ray.t_min));
    const auto outside = hn::And(hn::Lt(least_edge, zero), hn::Gt(most_edge, zero));
    missed |= bits_of(d, hn::Or(outside, hn::Or(too_far, too_near))) << first;
  }
  return ~missed & ((1U << TriangleBlock::kWidth) - 1);
}

// Distances and weights of the corners, for the triangles whose bit in `known` is set.
struct BlockHits {
  HWY_ALIGN float t[TriangleBlock::kWidth];
  HWY_ALIGN float weight[3][TriangleBlock::kWidth];
  std::uint32_t known;
};

// For triangles whose edge functions do not differ in sign.
HWY_INLINE BlockHits test_block(const BatchRay& ray, const TriangleBlock& block) {
  const hn::CappedTag<double, TriangleBlock::kWidth> dd;
  const hn::Rebind<float, decltype(dd)> df;
  using D = hn::Vec<decltype(dd)>;
  using F = hn::Vec<decltype(df)>;
  BlockHits hits;
  hits.known = 0;
  for (std::size_t first = 0; first < TriangleBlock::kWidth; first += hn::MaxLanes(dd)) {
    const ShearedTriangles<decltype(df)> triangles(df, ray, block, first);
    const F weights[3] = {hn::Abs(triangles.edge[0]), hn::Abs(triangles.edge[1]), hn::Abs(triangles.edge[2])};
    const F magnitude = hn::Abs(hn::Add(hn::Add(triangles.edge[0], triangles.edge[1]), triangles.edge[2]));
    const F least_weight = hn::Min(hn::Min(weights[0], weights[1]), weights[2]);
    const auto in_range =
        hn::And(hn::Ge(magnitude, hn::Set(df, 1e-30F)), hn::Le(magnitude, hn::Set(df, std::numeric_limits<float>::max())));
    const auto is_regular = hn::And(hn::Gt(least_weight, hn::Zero(df)), in_range);

    D corner[3][3];  // by corner and axis, relative to the origin
    D largest = hn::Zero(dd);
    for (int axis = 0; axis < 3; ++axis) {
      const D origin = hn::Set(dd, static_cast<double>(ray.ray().origin[axis]));
      for (int i = 0; i < 3; ++i) {
        corner[i][axis] = hn::Sub(hn::PromoteTo(dd, hn::LoadU(df, block.corners[axis][i] + first)), origin);
        largest = hn::Max(largest, hn::Abs(corner[i][axis]));
      }
    }
    D a[3];
    D b[3];
    D direction[3];
    for (int axis = 0; axis < 3; ++axis) {
      a[axis] = hn::Sub(corner[1][axis], corner[0][axis]);
      b[axis] = hn::Sub(corner[2][axis], corner[0][axis]);
      direction[axis] = hn::Set(dd, static_cast<double>(ray.ray().direction[axis]));
    }
    const D normal[3] = {hn::Sub(hn::Mul(a[1], b[2]), hn::Mul(b[1], a[2])), hn::Sub(hn::Mul(a[2], b[0]), hn::Mul(b[2], a[0])),
                         hn::Sub(hn::Mul(a[0], b[1]), hn::Mul(b[0], a[1]))};
    const D forward = hn::Set(dd, static_cast<double>(ray.ray().direction[static_cast<int>(ray.kz)]));
    const D plane_depth = hn::Mul(hn::Div(dot3(normal, corner[0]), dot3(normal, direction)), forward);

    D x[3];
    D y[3];
    D z[3];
    for (int i = 0; i < 3; ++i) {
      x[i] = hn::PromoteTo(dd, triangles.x[i]);
      y[i] = hn::PromoteTo(dd, triangles.y[i]);
      z[i] = hn::PromoteTo(dd, triangles.z[i]);
    }
    const D edges[3] = {hn::Sub(hn::Mul(x[2], y[1]), hn::Mul(x[1], y[2])), hn::Sub(hn::Mul(x[0], y[2]), hn::Mul(x[2], y[0])),
                        hn::Sub(hn::Mul(x[1], y[0]), hn::Mul(x[0], y[1]))};
    const D edge_depth = hn::Div(dot3(edges, z), hn::Add(hn::Add(edges[0], edges[1]), edges[2]));
    const auto agree = hn::Le(hn::Abs(hn::Sub(plane_depth, edge_depth)), hn::Mul(hn::Set(dd, watertight::kDepthTolerance), largest));

    hn::StoreU(hn::DemoteTo(df, hn::Div(plane_depth, forward)), df, hits.t + first);
    for (int i = 0; i < 3; ++i) hn::StoreU(weights[i], df, hits.weight[i] + first);
    hits.known |= (bits_of(df, is_regular) & bits_of(dd, agree)) << first;
  }
  return hits;
}

}  // namespace HWY_NAMESPACE
}  // namespace grove
HWY_AFTER_NAMESPACE();

#endif
