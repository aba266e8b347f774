#pragma once

#include <cmath>
#include <limits>

#include "grove/math/vector.h"

namespace grove {

/// Vertices and ray origins beyond this on any axis are never hit and never hit anything, so that sheared differences stay finite.
inline constexpr float kMaxCoordinate = 5e37F;

/// A ray segment: the points origin + t * direction with t_min <= t <= t_max. 32 bytes, in the order of the ray files.
/// The direction need not be of unit length; t is measured in units of its length.
/// A t_min below 0 counts as 0. t_max may be infinite. A ray with a NaN, an infinite direction, an origin beyond kMaxCoordinate,
/// a zero direction or t_min > t_max hits nothing.
struct Ray {
  Vec3 origin{0.0F};
  float t_min = 0.0F;
  Vec3 direction{0.0F, 0.0F, 1.0F};
  float t_max = std::numeric_limits<float>::infinity();

  [[nodiscard]] Vec3 at(float t) const { return origin + t * direction; }

  /// False for the rays that hit nothing by definition.
  [[nodiscard]] bool is_traceable() const {
    // A NaN fails every comparison.
    return is_within(origin, kMaxCoordinate) && is_within(direction, std::numeric_limits<float>::max()) &&
           (direction.x != 0.0F || direction.y != 0.0F || direction.z != 0.0F) && t_min <= t_max && t_max >= 0.0F;
  }

  /// Whether all coordinates are finite and at most `limit` in magnitude.
  [[nodiscard]] static bool is_within(const Vec3& v, float limit) {
    return std::fabs(v.x) <= limit && std::fabs(v.y) <= limit && std::fabs(v.z) <= limit;
  }
};

static_assert(sizeof(Ray) == 32);

}  // namespace grove
