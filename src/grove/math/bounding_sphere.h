#pragma once

#include "grove/math/box.h"
#include "grove/math/rounding.h"

namespace grove {

/// A solid sphere around other things.
///
///   bytes  0..11  centre
///   bytes 12..15  radius, not negative
struct BoundingSphere {
  Vec3 centre;
  float radius;

  [[nodiscard]] bool contains(const glm::dvec3& point) const {
    const glm::dvec3 from_centre = point - glm::dvec3(centre);
    return glm::dot(from_centre, from_centre) <= static_cast<double>(radius) * radius;
  }

  /// Half of the surface area, as Box::half_area.
  [[nodiscard]] float half_area() const { return 2.0F * kPi * radius * radius; }

  /// The axis-aligned box around it, rounded outward.
  [[nodiscard]] Box bounds() const {
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
      box.lower[axis] = round_down(static_cast<double>(centre[axis]) - radius);
      box.upper[axis] = round_up(static_cast<double>(centre[axis]) + radius);
    }
    return box;
  }
};

static_assert(sizeof(BoundingSphere) == 16);

}  // namespace grove
