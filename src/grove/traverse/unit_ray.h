#pragma once

// A ray as the tests of volumes see it: in the unit space of a hierarchy, with a direction of length 1, so that none of the products in a test
// overflows or vanishes.
//
// The tests are conservative: a volume is never skipped that holds a hit of one of the primitive tests. They widen it by `pad`, which is 64 u
// times L, where u = 2^-24 and L is the largest coordinate of the scene's bounds relative to the ray's origin. In units of u L, a hit may be
// off its primitive by 14 along each axis (traverse/slab_ray.h: 13 and the rounding of t), which is 24.3 in any direction, and the origin and
// the direction that are rounded here move it by 1.8 each. So a hit is within 28 of the volume that holds its primitive, as seen from the
// rounded ray; each test says how it keeps within the 36 that are left. Coordinates of the scene are at most L as well, since half its
// longest side is. Among denormal numbers each rounding of a primitive test is off by up to 2^-150 instead, and the 24.3 of them are covered by
// another 2^-144. A t that is denormal may be off by 2^-150 too.

#include <algorithm>
#include <cmath>
#include <limits>

#include "grove/geometry/ray.h"
#include "grove/math/bounding_volume.h"
#include "grove/math/unit_space.h"

namespace grove {

/// A ray set up for tests against volumes of the hierarchy that has `space` and `bounds`. The ray must be traceable.
struct UnitRay {
  Vec3 origin;
  Vec3 direction;  ///< of length 1, or 0 where every volume is met
  float pad;
  float t_min;  ///< distance in unit space, rounded down
  double rate;  ///< distance in unit space for each unit of t

  UnitRay(const Ray& ray, const UnitSpace& space, const Box& bounds) {
    const glm::dvec3 below = space.to_unit(bounds.lower) - space.to_unit(ray.origin);
    const glm::dvec3 above = space.to_unit(bounds.upper) - space.to_unit(ray.origin);
    const double largest = std::max(
        {std::fabs(below.x), std::fabs(below.y), std::fabs(below.z), std::fabs(above.x), std::fabs(above.y), std::fabs(above.z), kLeast});
    if (!(largest <= kMost)) {
      // From so far away the widening is more than the scene: a ray that moves nowhere, in the middle of a volume twice its size.
      origin = direction = Vec3(0.0F);
      pad = 4.0F;
      t_min = 0.0F;
      rate = 1.0;
      return;
    }
    const glm::dvec3 d(ray.direction);
    const double length = std::sqrt(glm::dot(d, d));
    origin = Vec3(space.to_unit(ray.origin));
    direction = Vec3(d * (1.0 / length));
    pad = static_cast<float>((largest * 0x1p-18 + 0x1p-144 * space.scale) * (1.0 + 0x1p-20));
    rate = length * space.scale;
    // Below 0 by next to nothing, or by a lot for a very long direction: a t just below 0 is rounded to -0, which counts as a hit.
    const double t = ((ray.t_min > 0.0F ? ray.t_min : 0.0F) - double{kLeastFloat}) * rate;
    t_min = static_cast<float>(t - std::fabs(t) * kSlack) - kLeastFloat;
  }

  /// The distance in unit space at `t`, rounded up.
  [[nodiscard]] float distance(float t) const {
    return static_cast<float>((t + double{kLeastFloat}) * rate) * (1.0F + kSlack) + kLeastFloat;
  }

 private:
  static constexpr float kLeastFloat = std::numeric_limits<float>::denorm_min();
  // Four units in the last place, for a product that is rounded to a float and multiplied once more.
  static constexpr float kSlack = 0x1p-22F;
  // A scene without extent has no size to compare with.
  static constexpr double kLeast = 0.5;
  // The widening reaches the size of the scene.
  static constexpr double kMost = 0x1p20;
};

/// The test of one ray against volumes of a kind: `test(volume, limit, entry)` returns whether the ray meets the volume between its t_min
/// and the distance `limit`, and sets `entry` to a distance that is not beyond the first point they share.
template <BoundingVolume V>
class VolumeTest;

}  // namespace grove
