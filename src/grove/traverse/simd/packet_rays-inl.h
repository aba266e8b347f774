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

#include "grove/geometry/hit.h"
#include "grove/geometry/ray.h"
#include "grove/traverse/simd/batch_ray.h"
#include "grove/traverse/simd/batch_slot.h"
#include "grove/traverse/simd/block_test-inl.h"
#include "grove/traverse/simd/ray_group-inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Up to kPacketRays rays, a multiple of sixteen, whose directions have the same signs, and whose triangles are tested along the same axes, as rows of numbers; BatchRay says what they
// are. A bit stands for each ray.
struct PacketRays {
  static constexpr std::size_t kCount = kPacketRays;
  using Set = std::uint64_t;
  static_assert(kCount == 64);
  using D = hn::CappedTag<float, 16>;

  HWY_ALIGN float inverse[4][kCount];         // of x, y and z; t_min
  HWY_ALIGN float near_offset[4][kCount];     // and the depth's pad
  HWY_ALIGN float far_offset[4][kCount];      // and inverse_z
  HWY_ALIGN float minus_origin_k[4][kCount];  // and shear_x
  HWY_ALIGN float direction_k[4][kCount];     // and shear_y
  // The closest hits. What is farther than t is not looked for: it begins as t_max.
  HWY_ALIGN float t[kCount];
  HWY_ALIGN float u[kCount];
  HWY_ALIGN float v[kCount];
  HWY_ALIGN std::uint32_t primitive[kCount];  // or kInvalidId
  std::size_t count = 0;
  PlaneRows rows;
  RayAxes axes;

  [[nodiscard]] const float* t_min() const { return inverse[3]; }

  // Takes `ray_count` rays of a group from number `first` on, which are a packet.
  HWY_INLINE void take(const RayGroup<kCount>& group, std::size_t first, std::size_t ray_count, const Ray* rays) {
    constexpr std::size_t kLanes = RayGroup<kCount>::Setup::kCount;
    rows = kPlaneRows[group.setup(first / kLanes).octant(0)];
    axes = kRayAxes[group.setup(first / kLanes).axes(0)];
    count = ray_count;
    for (std::size_t i = 0; i < count; i += kLanes)
      group.setup((first + i) / kLanes).store_rows(inverse, near_offset, far_offset, minus_origin_k, direction_k, i);
    for (std::size_t i = 0; i < count; ++i) {
      t[i] = rays[i].t_max;
      u[i] = 0.0F;
      v[i] = 0.0F;
      primitive[i] = kInvalidId;
    }
  }

  [[nodiscard]] Hit hit(std::size_t ray) const {
    Hit hit;
    hit.t = t[ray];
    hit.u = u[ray];
    hit.v = v[ray];
    hit.primitive = primitive[ray];
    return hit;
  }
  void set_hit(std::size_t ray, const Hit& hit) {
    t[ray] = hit.t;
    u[ray] = hit.u;
    v[ray] = hit.v;
    primitive[ray] = hit.primitive;
  }

  struct Pairs {
    Set possible = 0;
    Set certain = 0;
  };

  // Which of the rays may hit a triangle of a block; as filter_block.
  template <bool kTellCertain>
  [[nodiscard]] HWY_INLINE Pairs filter(const TriangleBlock& block, std::uint32_t place, Set some) const {
    const D d;
    Pairs pairs;
    for (std::size_t i = 0; i < count; i += hn::MaxLanes(d)) {
      if ((some >> i & ((std::uint64_t{1} << hn::MaxLanes(d)) - 1)) == 0) continue;
      const auto along = [&](std::uint32_t axis, int corner, int k) {
        return hn::Add(hn::Set(d, block.corners[axis][corner][place]), hn::Load(d, minus_origin_k[k] + i));
      };
      ShearedCorners<hn::Vec<D>> corners;
      for (int corner = 0; corner < 3; ++corner) {
        corners.set(corner, along(axes.kx, corner, 0), along(axes.ky, corner, 1), along(axes.kz, corner, 2),
                    hn::Load(d, minus_origin_k[3] + i), hn::Load(d, direction_k[3] + i));
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
