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

// Rays of a group that are a packet, and what they have hit. A bit stands for each ray.
struct PacketRays {
  static constexpr std::size_t kCount = kPacketRays;
  using Set = std::uint64_t;
  static_assert(kCount == 64);
  using D = hn::CappedTag<float, 16>;

  std::size_t count = 0;
  PlaneRows rows;
  RayAxes axes;
  // The closest hits. What is farther than t is not looked for: it begins as t_max.
  HWY_ALIGN float t[kCount];
  HWY_ALIGN float u[kCount];
  HWY_ALIGN float v[kCount];
  HWY_ALIGN std::uint32_t primitive[kCount];  // or kInvalidId

  // Rows of numbers, of which number i is that of ray i.
  [[nodiscard]] const float* inverse(int axis) const { return all_->inverse[axis] + first_; }
  [[nodiscard]] const float* t_min() const { return all_->inverse[3] + first_; }
  [[nodiscard]] const float* near_offset(int axis) const { return all_->near_offset[axis] + first_; }
  [[nodiscard]] const float* depth_pad() const { return all_->near_offset[3] + first_; }
  [[nodiscard]] const float* far_offset(int axis) const { return all_->far_offset[axis] + first_; }
  [[nodiscard]] const float* inverse_z() const { return all_->far_offset[3] + first_; }
  [[nodiscard]] const float* minus_origin_k(int k) const { return all_->minus_origin_k[k] + first_; }
  [[nodiscard]] const float* shear_x() const { return all_->minus_origin_k[3] + first_; }
  [[nodiscard]] const float* direction_k(int k) const { return all_->direction_k[k] + first_; }
  [[nodiscard]] const float* shear_y() const { return all_->direction_k[3] + first_; }

  // Takes `ray_count` rays of a group from number `first` on, which are a packet, while the group holds them. `rays` are these.
  HWY_INLINE void take(const RayGroup<kCount>& group, std::size_t first, std::size_t ray_count, const Ray* rays) {
    all_ = &group.rows();
    first_ = first;
    count = ray_count;
    rows = kPlaneRows[all_->octant[first]];
    axes = kRayAxes[all_->axes[first]];
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
        return hn::Add(hn::Set(d, block.corners[axis][corner][place]), hn::LoadU(d, minus_origin_k(k) + i));
      };
      ShearedCorners<hn::Vec<D>> corners;
      for (int corner = 0; corner < 3; ++corner) {
        corners.set(corner, along(axes.kx, corner, 0), along(axes.ky, corner, 1), along(axes.kz, corner, 2), hn::LoadU(d, shear_x() + i),
                    hn::LoadU(d, shear_y() + i));
      }
      const BlockFilter found = filter_sheared<kTellCertain>(d, corners, hn::LoadU(d, inverse_z() + i), hn::LoadU(d, depth_pad() + i),
                                                             hn::LoadU(d, t_min() + i), hn::Load(d, t + i));
      pairs.possible |= Set{found.possible} << i;
      pairs.certain |= Set{found.certain} << i;
    }
    pairs.possible &= some;
    pairs.certain &= some;
    return pairs;
  }

 private:
  const RayRows<kCount>* all_ = nullptr;
  std::size_t first_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace grove
HWY_AFTER_NAMESPACE();

#endif
