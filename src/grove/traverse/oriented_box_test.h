#pragma once

// Slabs along the axes of an oriented box, all three in one register. Where a box has the bounds [lower, upper] along an axis a, the ray enters and
// leaves them at (lower - a.o) / (a.d) and (upper - a.o) / (a.d).
//
// Rounding, in units of u L (traverse/unit_ray.h); sums of |a| are at most 1.74 and so a.o, lower and upper at most 1.74 L:
//
//   a.o                    three products and two sums: 3 * 1.74                             5.2
//   a.d                    3 * 1.74 times the distance, of which each component is below L   5.2
//   a.o +- pad             one sum                                                           1.8
//   lower - (a.o + pad)    one sum, of up to 3.5 L                                           3.5
//   1 / (a.d), product     each a unit of up to 3.5 L                                        7.0
//
// Together 22.7, of 36. A component of the direction that is almost zero is taken as 2^-60, which moves the ray by nothing that counts and
// leaves every quotient finite.

#include "grove/math/float4.h"
#include "grove/math/oriented_box.h"
#include "grove/traverse/unit_ray.h"

namespace grove {

template <>
class VolumeTest<OrientedBox> {
 public:
  explicit VolumeTest(const UnitRay& ray) : pad_(splat(ray.pad)), t_min_(ray.t_min) {
    for (int component = 0; component < 3; ++component) {
      origin_[component] = splat(ray.origin[component]);
      direction_[component] = splat(ray.direction[component]);
    }
  }

  [[nodiscard, gnu::always_inline]] bool operator()(const OrientedBox& box, float limit, float& entry) const {
    // Lane 3 of a load is what follows in the box: some number that takes part in nothing. The last load starts one place early instead.
    const auto* const floats = reinterpret_cast<const float*>(&box);
    const Float4 x = load4(floats);
    const Float4 y = load4(floats + 3);
    const Float4 z = load4(floats + 6);
    const Float4 lower = load4(floats + 9);
    const Float4 early = load4(floats + 11);
    const Float4 upper = __builtin_shufflevector(early, early, 1, 2, 3, 3);

    const Float4 o = x * origin_[0] + y * origin_[1] + z * origin_[2];
    const Float4 d = x * direction_[0] + y * direction_[1] + z * direction_[2];
    const Float4 inverse = splat(1.0F) / away_from_zero(d);
    const Float4 to_lower = (lower - (o + pad_)) * inverse;
    const Float4 to_upper = (upper - (o - pad_)) * inverse;
    const Float4 near = min(to_lower, to_upper);
    const Float4 far = -max(to_lower, to_upper);
    // The latest entry in lane 0 and the earliest exit, turned over, in lane 2.
    const Float4 pairs = max(__builtin_shufflevector(near, far, 0, 1, 4, 5), __builtin_shufflevector(near, far, 2, 2, 6, 6));
    const Float4 ends = max(pairs, __builtin_shufflevector(pairs, pairs, 1, 0, 3, 2));
    const float first = ends[0] > t_min_ ? ends[0] : t_min_;
    const float last = -ends[2] < limit ? -ends[2] : limit;
    entry = first;
    return first <= last;
  }

 private:
  [[nodiscard, gnu::always_inline]] static Float4 away_from_zero(Float4 d) {
    const Float4 least = splat(0x1p-60F);
    const Float4 magnitude = max(d, -d);
    return magnitude < least ? least : d;
  }

  Float4 origin_[3];
  Float4 direction_[3];
  Float4 pad_;
  float t_min_;
};

}  // namespace grove
