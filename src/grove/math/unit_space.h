#pragma once

// A scene brought to the size of one. Volumes other than axis-aligned boxes are made of products and sums of coordinates; here none of these
// overflows or vanishes, however large or small or far from its origin the scene is.

#include <algorithm>
#include <cmath>

#include "grove/math/box.h"
#include "grove/math/rounding.h"

namespace grove {

/// Coordinates in which a scene's box has its centre in the origin and a longest side of at least 1 and less than 2. A box without any extent
/// keeps its size.
struct UnitSpace {
  glm::dvec3 centre{0.0};
  double scale = 1.0;  ///< a power of two, so that scaling rounds nothing

  UnitSpace() = default;
  explicit UnitSpace(const Box& scene) {
    if (scene.is_empty()) return;
    const glm::dvec3 lower(scene.lower);
    const glm::dvec3 side = glm::dvec3(scene.upper) - lower;
    centre = 0.5 * (lower + glm::dvec3(scene.upper));
    const double longest = std::max({side.x, side.y, side.z});
    if (longest > 0.0) scale = std::ldexp(1.0, -std::ilogb(longest));
  }

  [[nodiscard]] glm::dvec3 to_unit(const glm::dvec3& point) const { return (point - centre) * scale; }
  [[nodiscard]] glm::dvec3 to_unit(const Vec3& point) const { return to_unit(glm::dvec3(point)); }

  /// A box of the scene as a box of this space, rounded outward.
  [[nodiscard]] Box to_unit(const Box& box) const { return round_outward(to_unit(box.lower), to_unit(box.upper)); }

  /// A box of this space as a box of the scene, rounded outward.
  [[nodiscard]] Box to_scene(const Box& box) const {
    return round_outward(centre + glm::dvec3(box.lower) / scale, centre + glm::dvec3(box.upper) / scale);
  }

 private:
  static Box round_outward(const glm::dvec3& lower, const glm::dvec3& upper) {
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
      box.lower[axis] = round_down(lower[axis]);
      box.upper[axis] = round_up(upper[axis]);
    }
    return box;
  }
};

}  // namespace grove
