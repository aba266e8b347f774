#pragma once

// Where a ray is with regard to the planes of a kd-tree, conservatively.
//
// A hit may be off its primitive by rounding (slab_ray.h bounds by how much), so a plane is not a sharp border for a ray but a band of that
// half width: up to `departure` the ray may meet something that lies on the nearer side, from `entry` on something on the farther side. In between both
// sides count. A ray in or near the plane has entry = -infinity and departure = infinity, or NaN for either, which means the same: comparisons are
// written so that NaN sets no limit. This takes the place of moving hits or rays by an epsilon.

#include <cstdint>

#include "grove/traverse/slab_ray.h"

namespace grove {

class KdRay {
 public:
  KdRay(const Ray& ray, const Box& bounds) {
    const SlabRay slabs(ray, bounds);
    for (int axis = 0; axis < 3; ++axis)
      axis_[axis] = {slabs.origin_near[axis], slabs.inverse_near[axis], slabs.origin_far[axis], slabs.inverse_far[axis],
                     slabs.negative[axis] ? 1U : 0U};
  }

  /// Index of the nearer child of a node on this axis: 1 when the ray comes from above.
  [[nodiscard]] std::uint32_t near_side(std::uint32_t axis) const { return axis_[axis].is_negative; }
  /// The first t at which the ray may meet something on the farther side of a plane, or NaN.
  [[nodiscard]] float entry(std::uint32_t axis, float plane) const { return (plane - axis_[axis].origin_near) * axis_[axis].inverse_near; }
  /// The last t at which it may meet something on the nearer side, or NaN.
  [[nodiscard]] float departure(std::uint32_t axis, float plane) const {
    return (plane - axis_[axis].origin_far) * axis_[axis].inverse_far;
  }

  /// Narrows [first, last] to the stretch of the ray that may meet something in the box. Empty (first > last) where it passes by.
  void clip(const Box& box, float& first, float& last) const {
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const int i = static_cast<int>(axis);
      const bool is_negative = axis_[axis].is_negative != 0;
      const float into = entry(axis, is_negative ? box.upper[i] : box.lower[i]);
      const float out = departure(axis, is_negative ? box.lower[i] : box.upper[i]);
      first = into > first ? into : first;
      last = out < last ? out : last;
    }
  }

 private:
  struct Axis {
    float origin_near, inverse_near, origin_far, inverse_far;
    std::uint32_t is_negative;
  };
  Axis axis_[3];
};

}  // namespace grove
