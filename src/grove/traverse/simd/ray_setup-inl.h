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
#include <cstddef>
#include <cstdint>

#include "grove/math/box.h"
#include "grove/traverse/simd/batch_ray.h"
#include "grove/traverse/simd/compaction-inl.h"
#include "grove/traverse/simd/ray_rows.h"

HWY_BEFORE_NAMESPACE();
namespace grove {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// As many rays at once as a register of up to kMost lanes holds.
template <std::size_t kMost>
class RaySetup {
  using D = hn::CappedTag<float, kMost>;
  using DU = hn::RebindToUnsigned<D>;
  using V = hn::Vec<D>;

 public:
  static constexpr std::size_t kCount = hn::MaxLanes(D());

  explicit RaySetup(const Box& bounds) : bounds_(bounds) {}

  // Sets up rays [0, count), 1 to kCount of them, as those of `rows` from `first` on; behind them the last is set up again. Returns which the kernels can
  // take, a bit for each. Not: rays that hit nothing by definition, and those whose numbers are not where the rounding above is bounded, which are coordinates
  // beyond 2^60, a scene that reaches less than 2^-60 from the origin, and directions whose longest component is below 2^-20 or above 2^20.
  template <std::size_t kLength>
  HWY_INLINE std::uint32_t prepare(const Ray* rays, std::size_t count, RayRows<kLength>& rows, std::size_t first) const {
    if (count == kCount) return prepare_rows(load(rays), rows, first);
    Ray padded[kCount];
    for (std::size_t i = 0; i < kCount; ++i) padded[i] = rays[std::min(i, count - 1)];
    return prepare_rows(load(padded), rows, first);
  }

  // One ray that is set up, where a kernel may yet refuse it.
  class One {
   public:
    HWY_INLINE void copy(BatchRay& to) const {
      const float* const parts[5] = {by_lane_[0], by_lane_[1], by_lane_[2], by_lane_[3], by_lane_[4]};
      to.set(parts, octant_[0], axes_[0], *ray_);
    }

   private:
    friend class RaySetup;
    const Ray* ray_;
    HWY_ALIGN float by_lane_[5][4 * kCount];
    HWY_ALIGN std::uint32_t octant_[kCount];
    HWY_ALIGN std::uint32_t axes_[kCount];
  };

  // The same for one ray.
  HWY_INLINE bool prepare(const Ray& ray, One& one) const {
    const D d;
    const auto all = [&](const Vec3& v, V lanes[3]) {
      for (int axis = 0; axis < 3; ++axis) lanes[axis] = hn::Set(d, v[axis]);
    };
    Rays same{{}, {}, hn::Set(d, ray.t_min), hn::Set(d, ray.t_max)};
    all(ray.origin, same.origin);
    all(ray.direction, same.direction);
    one.ray_ = &ray;
    const auto store = [&](int part, V x, V y, V z, V fourth) { hn::StoreInterleaved4(x, y, z, fourth, d, one.by_lane_[part]); };
    const auto number = [&](hn::Vec<DU> octants, hn::Vec<DU> kinds_of_axes) {
      const DU du;
      hn::Store(octants, du, one.octant_);
      hn::Store(kinds_of_axes, du, one.axes_);
    };
    return (prepare(same, store, number) & 1U) != 0;
  }

 private:
  struct Rays {
    V origin[3];
    V direction[3];
    V t_min;
    V t_max;
  };

  template <std::size_t kLength>
  HWY_INLINE std::uint32_t prepare_rows(const Rays& rays, RayRows<kLength>& rows, std::size_t first) const {
    const D d;
    float(*const part_of[5])[kLength] = {rows.inverse, rows.near_offset, rows.far_offset, rows.minus_origin_k, rows.direction_k};
    const auto store = [&](int part, V x, V y, V z, V fourth) {
      const V four[4] = {x, y, z, fourth};
      for (int k = 0; k < 4; ++k) hn::StoreU(four[k], d, part_of[part][k] + first);
    };
    const auto number = [&](hn::Vec<DU> octants, hn::Vec<DU> kinds_of_axes) {
      const DU du;
      hn::StoreU(octants, du, rows.octant + first);
      hn::StoreU(kinds_of_axes, du, rows.axes + first);
    };
    return prepare(rays, store, number);
  }

  // Every other lane of both, from the first or the second on.
  static HWY_INLINE V by_turns(V front, V back, bool from_second) {
#if HWY_TARGET == HWY_SCALAR
    return from_second ? back : front;
#else
    const D d;
    return from_second ? hn::ConcatOdd(d, back, front) : hn::ConcatEven(d, back, front);
#endif
  }

  // A ray is eight floats in a row.
  static HWY_INLINE Rays load(const Ray* rays) {
    const D d;
    static_assert(sizeof(Ray) == 8 * sizeof(float) && offsetof(Ray, direction) == 4 * sizeof(float));
    const auto* const floats = reinterpret_cast<const float*>(rays);
    Rays loaded;
    // Of the first half of the rays, and of the second.
    V front[4];
    V back[4];
    hn::LoadInterleaved4(d, floats, front[0], front[1], front[2], front[3]);
    hn::LoadInterleaved4(d, floats + 4 * kCount, back[0], back[1], back[2], back[3]);
    // Origins and directions come by turns.
    const auto origin_part = [&](int k) { return by_turns(front[k], back[k], false); };
    const auto direction_part = [&](int k) { return by_turns(front[k], back[k], true); };
    for (int axis = 0; axis < 3; ++axis) {
      loaded.origin[axis] = origin_part(axis);
      loaded.direction[axis] = direction_part(axis);
    }
    loaded.t_min = origin_part(3);
    loaded.t_max = direction_part(3);
    return loaded;
  }

  static HWY_INLINE V largest(const V v[3]) {
    return hn::Max(hn::Max(v[0], v[1]), v[2]);
  }

  // Gives the parts of BatchRay to store(part, x, y, z, fourth), in its order, and number(octants, axes) what it looks up. Returns which rays the kernels can take.
  template <typename Store, typename Number>
  HWY_INLINE std::uint32_t prepare(const Rays& rays, const Store& store, const Number& number) const {
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

    const std::uint32_t regular = bits_of(d, is_regular);

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

    store(0, inverse[0], inverse[1], inverse[2], hn::Max(rays.t_min, zero));
    store(1, near_offset[0], near_offset[1], near_offset[2], depth_pad);
    store(2, far_offset[0], far_offset[1], far_offset[2], inverse_z);
    store(3, hn::Neg(origin_k[0]), hn::Neg(origin_k[1]), hn::Neg(origin_k[2]), shear_x);
    store(4, direction_k[0], direction_k[1], direction_k[2], shear_y);
    const auto bits = [&](std::uint32_t n) { return hn::BitCast(d, hn::Set(du, n)); };
    const auto twice_kz = hn::BitCast(du, select(bits(4), bits(2), bits(0)));
    number(octant, hn::Or(twice_kz, hn::ShiftRight<31>(hn::BitCast(du, direction_z))));
    return regular;
  }

  const Box bounds_;
};

}  // namespace HWY_NAMESPACE
}  // namespace grove
HWY_AFTER_NAMESPACE();

#endif
