#pragma once

#include <cmath>
#include <limits>

#include "grove/math/vector.h"

namespace grove {

/// A ray segment: the points origin + t * direction with t_min <= t <= t_max. 32 bytes, in the order of the ray files.
/// The direction need not be of unit length; t is measured in units of its length.
/// A t_min below 0 counts as 0. t_max may be infinite. A ray with a NaN, an infinite origin or direction, a zero direction or
/// t_min > t_max hits nothing.
struct Ray {
  Vec3 origin{0.0F};
  float t_min = 0.0F;
  Vec3 direction{0.0F, 0.0F, 1.0F};
  float t_max = std::numeric_limits<float>::infinity();

  [[nodiscard]] Vec3 at(float t) const { return origin + t * direction; }

  /// False for the rays that hit nothing by definition.
  [[nodiscard]] bool is_traceable() const {
    // A sum of zeros times values is 0 when all are finite and NaN otherwise.
    const Vec3 zero = 0.0F * origin + 0.0F * direction;
    return zero.x + zero.y + zero.z == 0.0F &&
           (direction.x != 0.0F || direction.y != 0.0F || direction.z != 0.0F) && t_min <= t_max && t_max >= 0.0F;
  }
};

static_assert(sizeof(Ray) == 32);

}  // namespace grove
