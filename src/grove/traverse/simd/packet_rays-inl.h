// The rays of a packet, side by side. Included once for each instruction set.

#if defined(GROVE_PACKET_RAYS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_PACKET_RAYS_INL_H
#undef GROVE_PACKET_RAYS_INL_H
#else
#define GROVE_PACKET_RAYS_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "grove/geometry/ray.h"
#include "grove/traverse/simd/batch_ray.h"
#include "grove/traverse/simd/batch_slot.h"
#include "grove/traverse/simd/block_test-inl.h"
#include "grove/traverse/simd/ray_group-inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// kPacketRays rays whose directions have the same signs, as rows of numbers; BatchRay says what they are. A bit stands for each ray.
struct PacketRays {
  static constexpr std::size_t kCount = kPacketRays;
  using Set = std::uint32_t;
  static_assert(kCount == 32);
  using D = hn::CappedTag<float, 16>;

  HWY_ALIGN float inverse[4][kCount];         // of x, y and z; t_min
  HWY_ALIGN float near_offset[4][kCount];     // and the depth's pad
  HWY_ALIGN float far_offset[4][kCount];      // and inverse_z
  HWY_ALIGN float minus_origin_k[4][kCount];  // and shear_x
  HWY_ALIGN float shear_y[kCount];
  HWY_ALIGN float t[kCount];  // what is farther is not looked for
  PlaneRows rows;
  RayAxes axes;
  bool has_one_kind_of_axes;  // else `axes` are those of the first ray only

  [[nodiscard]] const float* t_min() const { return inverse[3]; }

  // Takes the rays of a group that is a packet.
  HWY_INLINE void take(const RayGroup<kCount>& group, const Ray* rays) {
    rows = kPlaneRows[group.setup(0).octant(0)];
    axes = kRayAxes[group.setup(0).axes(0)];
    has_one_kind_of_axes = group.has_one_kind_of_axes();
    for (std::size_t i = 0; i < group.kSetups; ++i)
      group.setup(i).store_rows(inverse, near_offset, far_offset, minus_origin_k, shear_y, i * RayGroup<kCount>::Setup::kCount);
    for (std::size_t i = 0; i < kCount; ++i) t[i] = rays[i].t_max;
  }

  struct Pairs {
    Set possible = 0;
    Set certain = 0;
  };

  // Which of the rays may hit a triangle of a block; as filter_block, for rays with one kind of axes.
  template <bool kTellCertain>
  [[nodiscard]] HWY_INLINE Pairs filter(const TriangleBlock& block, std::uint32_t place, Set some) const {
    const D d;
    Pairs pairs;
    for (std::size_t i = 0; i < kCount; i += hn::MaxLanes(d)) {
      if ((some >> i & ((std::uint64_t{1} << hn::MaxLanes(d)) - 1)) == 0) continue;
      const auto along = [&](std::uint32_t axis, int corner, int k) {
        return hn::Add(hn::Set(d, block.corners[axis][corner][place]), hn::Load(d, minus_origin_k[k] + i));
      };
      ShearedCorners<hn::Vec<D>> corners;
      for (int corner = 0; corner < 3; ++corner) {
        corners.set(corner, along(axes.kx, corner, 0), along(axes.ky, corner, 1), along(axes.kz, corner, 2),
                    hn::Load(d, minus_origin_k[3] + i), hn::Load(d, shear_y + i));
      }
      const BlockFilter found = filter_sheared<kTellCertain>(d, corners, hn::Load(d, far_offset[3] + i), hn::Load(d, near_offset[3] + i),
                                                             hn::Load(d, t_min() + i), hn::Load(d, t + i));
      pairs.possible |= Set{found.possible} << i;
      pairs.certain |= Set{found.certain} << i;
    }
    pairs.possible &= some;
    pairs.certain &= some;
    return pairs;
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace grove
HWY_AFTER_NAMESPACE();

#endif
