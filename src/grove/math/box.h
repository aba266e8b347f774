#pragma once

#include <limits>

#include "grove/math/vector.h"

namespace grove {

/// Axis-aligned box, closed. Empty (lower > upper) when default-made; growing it by a NaN point leaves it as it was.
struct Box {
  Vec3 lower{std::numeric_limits<float>::infinity()};
  Vec3 upper{-std::numeric_limits<float>::infinity()};

  [[nodiscard]] bool is_empty() const { return !(lower.x <= upper.x && lower.y <= upper.y && lower.z <= upper.z); }

  // `candidate < current ? candidate : current` keeps the current bound when the candidate is NaN.
  void grow(const Vec3& point) {
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = point[axis] < lower[axis] ? point[axis] : lower[axis];
      upper[axis] = point[axis] > upper[axis] ? point[axis] : upper[axis];
    }
  }

  void grow(const Box& other) {
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = other.lower[axis] < lower[axis] ? other.lower[axis] : lower[axis];
      upper[axis] = other.upper[axis] > upper[axis] ? other.upper[axis] : upper[axis];
    }
  }

  /// The part that both boxes share; empty when they do not touch.
  [[nodiscard]] Box intersection(const Box& other) const { return {glm::max(lower, other.lower), glm::min(upper, other.upper)}; }

  [[nodiscard]] bool contains(const Box& other) const {
    return other.is_empty() || (lower.x <= other.lower.x && lower.y <= other.lower.y && lower.z <= other.lower.z &&
                                upper.x >= other.upper.x && upper.y >= other.upper.y && upper.z >= other.upper.z);
  }

  [[nodiscard]] Vec3 extent() const { return upper - lower; }

  /// Halved before adding, so that it is finite whenever the box is.
  [[nodiscard]] Vec3 centre() const { return 0.5F * lower + 0.5F * upper; }

  /// Half of the surface area: the sum of three side products; 0 when empty. All that ratios of areas need.
  [[nodiscard]] float half_area() const {
    if (is_empty()) return 0.0F;
    const Vec3 d = extent();
    return d.x * (d.y + d.z) + d.y * d.z;
  }

  [[nodiscard]] float surface_area() const { return 2.0F * half_area(); }

  /// 0, 1 or 2: the axis of the longest side; the lowest of equals.
  [[nodiscard]] int longest_axis() const {
    const Vec3 d = extent();
    int axis = 0;
    if (d.y > d[axis]) axis = 1;
    if (d.z > d[axis]) axis = 2;
    return axis;
  }
};

}  // namespace grove
