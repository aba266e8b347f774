// Sets up rays for the batch kernel, as many at once as a register has lanes. Included once for each instruction set.
//
// A plane at p is met at t = p * inverse + offset, in one fused step. The offsets hold the origin moved by a pad, as in slab_ray.h, where 17 u of the
// largest coordinate relative to the origin are accounted for (u = 2^-24). The fused step rounds once where that test rounds twice, but
// the product in the offset has an error of u of the origin's own coordinate, and so has moving it: 4 u of that are added.
// Directions are kept away from 0 by 2^-40 of the longest component. Such a ray leaves a padded slab that holds its origin later than any
// other: after 2^40 * 24 u, more than 2^20, times the reach.

#if defined(GROVE_RAY_SETUP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_RAY_SETUP_INL_H
#undef GROVE_RAY_SETUP_INL_H
#else
#define GROVE_RAY_SETUP_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstring>

#include "grove/math/box.h"
#include "grove/traverse/simd/batch_ray.h"
#include "grove/traverse/simd/compaction-inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Of up to kMost rays at once.
template <std::size_t kMost>
class RaySetup {
  using D = hn::CappedTag<float, kMost>;
  using DU = hn::RebindToUnsigned<D>;
  using V = hn::Vec<D>;

 public:
  static constexpr std::size_t kCount = hn::MaxLanes(D());

  explicit RaySetup(const Box& bounds) : bounds_(bounds) {}

  // Sets up rays [0, count), up to kCount of them.
  HWY_INLINE void prepare(const Ray* rays, std::size_t count) {
    rays_ = rays;
    HWY_ALIGN float lanes[8][kCount];
    for (std::size_t i = 0; i < kCount; ++i) {
      const Ray& ray = rays[std::min(i, count - 1)];
      for (int axis = 0; axis < 3; ++axis) {
        lanes[axis][i] = ray.origin[axis];
        lanes[3 + axis][i] = ray.direction[axis];
      }
      lanes[6][i] = ray.t_min;
      lanes[7][i] = ray.t_max;
    }
    const D d;
    const auto load = [&](int row) { return hn::Load(d, lanes[row]); };
    prepare({{load(0), load(1), load(2)}, {load(3), load(4), load(5)}, load(6), load(7)});
  }

  // Sets up one ray, number 0.
  HWY_INLINE void prepare(const Ray& ray) {
    rays_ = &ray;
    const D d;
    const auto all = [&](const Vec3& v, V lanes[3]) {
      for (int axis = 0; axis < 3; ++axis) lanes[axis] = hn::Set(d, v[axis]);
    };
    Rays rays{{}, {}, hn::Set(d, ray.t_min), hn::Set(d, ray.t_max)};
    all(ray.origin, rays.origin);
    all(ray.direction, rays.direction);
    prepare(rays);
  }

  // Whether the kernel can take ray i. Not: rays that hit nothing by definition, and those whose numbers are not where the rounding above is
  // bounded, which are coordinates beyond 2^60, a scene that reaches less than 2^-60 from the origin, and directions whose longest component is below
  // 2^-20 or above 2^20.
  [[nodiscard]] bool is_regular(std::size_t i) const { return (regular_ >> i & 1U) != 0; }

  // Of all rays.
  [[nodiscard]] bool is_regular() const { return regular_ == (1U << kCount) - 1; }

  // By the signs of the direction, as nodes number their orders.
  [[nodiscard]] std::uint32_t octant(std::size_t i) const { return octant_[i]; }
  [[nodiscard]] bool has_one_octant() const {
    const DU du;
    return hn::AllTrue(du, hn::Eq(hn::Load(du, octant_), hn::Set(du, octant_[0])));
  }

  // The axes that the test of triangles takes them along.
  [[nodiscard]] std::uint32_t axes(std::size_t i) const { return axes_[i]; }
  [[nodiscard]] bool has_one_kind_of_axes() const {
    const DU du;
    return hn::AllTrue(du, hn::Eq(hn::Load(du, axes_), hn::Set(du, axes_[0])));
  }

  // What BatchRay has, in rows, of which ray 0 has place `first`.
  template <std::size_t kLength>
  HWY_INLINE void store_rows(float (*inverse)[kLength], float (*near_offset)[kLength], float (*far_offset)[kLength],
                             float (*minus_origin_k)[kLength], float (*direction_k)[kLength], std::size_t first) const {
    const D d;
    V v[4];
    const auto store = [&](const float* four, float(*rows)[kLength]) {
      hn::LoadInterleaved4(d, four, v[0], v[1], v[2], v[3]);
      for (int row = 0; row < 4; ++row) hn::StoreU(v[row], d, rows[row] + first);
    };
    store(inverse_, inverse);
    store(near_offset_, near_offset);
    store(far_offset_, far_offset);
    store(minus_origin_k_, minus_origin_k);
    store(direction_k_, direction_k);
  }

  HWY_INLINE void copy(std::size_t i, BatchRay& ray) const {
    std::memcpy(ray.inverse, inverse_ + 4 * i, 16);
    std::memcpy(ray.near_offset, near_offset_ + 4 * i, 16);
    std::memcpy(ray.far_offset, far_offset_ + 4 * i, 16);
    std::memcpy(ray.minus_origin_k, minus_origin_k_ + 4 * i, 16);
    std::memcpy(ray.direction_k, direction_k_ + 4 * i, 16);
    ray.rows = kPlaneRows[octant_[i]];
    ray.axes = kRayAxes[axes_[i]];
    ray.ray = rays_ + i;
  }

 private:
  struct Rays {
    V origin[3];
    V direction[3];
    V t_min;
    V t_max;
  };

  static HWY_INLINE V largest(const V v[3]) { return hn::Max(hn::Max(v[0], v[1]), v[2]); }

  HWY_INLINE void prepare(const Rays& rays) {
    const D d;
    const DU du;
    const V zero = hn::Zero(d);
    V length[3];
    V extent[3];
    V reach[3];
    for (int axis = 0; axis < 3; ++axis) {
      length[axis] = hn::Abs(rays.direction[axis]);
      extent[axis] = hn::Abs(rays.origin[axis]);
      reach[axis] = hn::Max(hn::Abs(hn::Sub(hn::Set(d, bounds_.lower[axis]), rays.origin[axis])),
                            hn::Abs(hn::Sub(hn::Set(d, bounds_.upper[axis]), rays.origin[axis])));
    }
    const V longest = largest(length);
    const V farthest = largest(reach);
    const V most = largest(extent);
    // A NaN fails a comparison. The reach bounds the scene's own coordinates.
    auto is_regular = hn::And(hn::And(hn::Ge(longest, hn::Set(d, 0x1p-20F)), hn::Ge(farthest, hn::Set(d, 0x1p-60F))),
                              hn::And(hn::Le(rays.t_min, rays.t_max), hn::Ge(rays.t_max, zero)));
    for (int axis = 0; axis < 3; ++axis) {
      is_regular = hn::And(is_regular, hn::Le(length[axis], hn::Set(d, 0x1p20F)));
      is_regular = hn::And(is_regular, hn::And(hn::Le(extent[axis], hn::Set(d, 0x1p60F)), hn::Le(reach[axis], hn::Set(d, 0x1p60F))));
    }
    regular_ = bits_of(d, is_regular);

    const V pad = hn::Add(hn::Mul(hn::Set(d, 0x1.8p-20F), farthest), hn::Mul(hn::Set(d, 0x1p-22F), most));
    const V least = hn::Mul(hn::Set(d, 0x1p-40F), longest);
    V inverse[3];
    V near_offset[3];
    V far_offset[3];
    auto octant = hn::Zero(du);
    for (int axis = 0; axis < 3; ++axis) {
      const V direction = rays.direction[axis];
      const V kept = hn::IfThenElse(hn::Ge(length[axis], least), direction, hn::CopySign(least, direction));
      inverse[axis] = hn::Div(hn::Set(d, 1.0F), kept);
      const V shift = hn::CopySign(pad, direction);
      near_offset[axis] = hn::Neg(hn::Mul(hn::Add(rays.origin[axis], shift), inverse[axis]));
      far_offset[axis] = hn::Neg(hn::Mul(hn::Sub(rays.origin[axis], shift), inverse[axis]));
      octant = hn::Or(octant, hn::ShiftLeftSame(hn::ShiftRight<31>(hn::BitCast(du, direction)), axis));
    }

    // The last of the longest, as WatertightRay chooses.
    const auto is_z = hn::Eq(length[2], longest);
    const auto is_y = hn::Eq(length[1], longest);
    const auto select = [&](V if_z, V if_y, V if_x) { return hn::IfThenElse(is_z, if_z, hn::IfThenElse(is_y, if_y, if_x)); };
    const V direction_z = select(rays.direction[2], rays.direction[1], rays.direction[0]);
    const auto is_negative = hn::Lt(direction_z, zero);
    const auto along = [&](const V v[3], V k[3]) {
      const V next = select(v[0], v[2], v[1]);
      const V last = select(v[1], v[0], v[2]);
      k[0] = hn::IfThenElse(is_negative, last, next);
      k[1] = hn::IfThenElse(is_negative, next, last);
      k[2] = select(v[2], v[1], v[0]);
    };
    V origin_k[3];
    V direction_k[3];
    along(rays.origin, origin_k);
    along(rays.direction, direction_k);
    const V inverse_z = hn::Div(hn::Set(d, 1.0F), direction_z);
    const V shear_x = hn::Div(direction_k[0], direction_z);
    const V shear_y = hn::Div(direction_k[1], direction_z);
    const V depth_pad = hn::Mul(pad, hn::Abs(inverse_z));

    hn::StoreInterleaved4(inverse[0], inverse[1], inverse[2], hn::Max(rays.t_min, zero), d, inverse_);
    hn::StoreInterleaved4(near_offset[0], near_offset[1], near_offset[2], depth_pad, d, near_offset_);
    hn::StoreInterleaved4(far_offset[0], far_offset[1], far_offset[2], inverse_z, d, far_offset_);
    hn::StoreInterleaved4(hn::Neg(origin_k[0]), hn::Neg(origin_k[1]), hn::Neg(origin_k[2]), shear_x, d, minus_origin_k_);
    hn::StoreInterleaved4(direction_k[0], direction_k[1], direction_k[2], shear_y, d, direction_k_);
    hn::Store(octant, du, octant_);
    const auto number = [&](std::uint32_t n) { return hn::BitCast(d, hn::Set(du, n)); };
    const auto twice_kz = hn::BitCast(du, select(number(4), number(2), number(0)));
    hn::Store(hn::Or(twice_kz, hn::ShiftRight<31>(hn::BitCast(du, direction_z))), du, axes_);
  }

  const Box bounds_;
  const Ray* rays_ = nullptr;
  std::uint32_t regular_ = 0;
  // By ray, as BatchRay has them.
  HWY_ALIGN float inverse_[4 * kCount];
  HWY_ALIGN float near_offset_[4 * kCount];
  HWY_ALIGN float far_offset_[4 * kCount];
  HWY_ALIGN float minus_origin_k_[4 * kCount];
  HWY_ALIGN float direction_k_[4 * kCount];
  HWY_ALIGN std::uint32_t octant_[kCount];
  HWY_ALIGN std::uint32_t axes_[kCount];
};

}  // namespace HWY_NAMESPACE
}  // namespace grove
HWY_AFTER_NAMESPACE();

#endif
