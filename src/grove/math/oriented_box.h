#pragma once

#include "grove/math/box.h"

namespace grove {

/// A box in any orientation: the points between three pairs of planes, whose normals are the columns of `axes`. The normals are orthonormal as
/// far as floats can be; which points are inside does not depend on it.
///
///   bytes  0..35  axes[component][axis], so that one register holds a component of all three axes
///   bytes 36..59  lower[axis], upper[axis]: bounds of the products of axis and point
struct OrientedBox {
  float axes[3][3];
  float lower[3];
  float upper[3];

  /// The same points as an axis-aligned box.
  [[nodiscard]] static OrientedBox aligned(const Box& box);

  /// Where a point lies along an axis.
  [[nodiscard]] double along(int axis, const glm::dvec3& point) const {
    return static_cast<double>(axes[0][axis]) * point.x + static_cast<double>(axes[1][axis]) * point.y +
           static_cast<double>(axes[2][axis]) * point.z;
  }

  [[nodiscard]] bool contains(const glm::dvec3& point) const {
    for (int axis = 0; axis < 3; ++axis) {
      const double p = along(axis, point);
      if (!(p >= lower[axis] && p <= upper[axis])) return false;
    }
    return true;
  }

  /// Half of the surface area, as Box::half_area.
  [[nodiscard]] float half_area() const {
    const float x = upper[0] - lower[0];
    const float y = upper[1] - lower[1];
    const float z = upper[2] - lower[2];
    return x * (y + z) + y * z;
  }

  /// An axis-aligned box that encloses it, larger by up to 1e-6 of the largest coordinate.
  [[nodiscard]] Box bounds() const;
};

static_assert(sizeof(OrientedBox) == 60);

}  // namespace grove
