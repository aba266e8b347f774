#pragma once

// The point of the ray nearest to the sphere's centre, and half a chord from there both ways. As in the test of primitive spheres, the distance of the centre
// from the ray is taken from that point and not from differences of large squares (Haines, Günther, Akenine-Möller, "Precision Improvements
// for Ray/Sphere Intersection", Ray Tracing Gems 2019).
//
// Rounding, in units of u L (traverse/unit_ray.h). Centres lie inside the scene's bounds, so v = centre - origin is at most 1.74 L long,
// and it is off by 1.8. Let b = v.d as computed, off by 5.2, and w = v - b d as computed, off by 3.5. Because d is not quite of length 1 and b not
// quite v.d, w is not quite at a right angle to d: |d.w| <= 8.7. A hit at distance t is within R1 = R + 28 + 1.8 of the centre as computed, so
//
//   (t - b)^2 <= R1^2 - |w|^2 + terms of second order, up to 8.7.
//
// With R1 and |w| at most R + 38, and R at most 1.74 L, the errors of |w|^2, (R + pad)^2 and their difference are below 25 R1 and 150,
// while (R + pad)^2 exceeds R1^2 by 2 * 34 R1 + 34^2: what is computed under the root is never too small. The root, the sum with b, and the 8.7 come to 18;
// half the chord is made longer by `pad` on both ends.

#include <cmath>

#include "grove/math/bounding_sphere.h"
#include "grove/traverse/unit_ray.h"

namespace grove {

template <>
class VolumeTest<BoundingSphere> {
 public:
  explicit VolumeTest(const UnitRay& ray) : origin_(ray.origin), direction_(ray.direction), pad_(ray.pad), t_min_(ray.t_min) {}

  [[nodiscard, gnu::always_inline]] bool operator()(const BoundingSphere& sphere, float limit, float& entry) const {
    const Vec3 v = sphere.centre - origin_;
    const float b = v.x * direction_.x + v.y * direction_.y + v.z * direction_.z;
    const Vec3 w = v - b * direction_;
    const float radius = sphere.radius + pad_;
    const float squared = radius * radius - (w.x * w.x + w.y * w.y + w.z * w.z);
    if (!(squared >= 0.0F)) return false;
    const float half_chord = std::sqrt(squared) + pad_;
    const float near = b - half_chord;
    const float far = b + half_chord;
    entry = near > t_min_ ? near : t_min_;
    return entry <= (far < limit ? far : limit);
  }

 private:
  Vec3 origin_;
  Vec3 direction_;
  float pad_;
  float t_min_;
};

}  // namespace grove
