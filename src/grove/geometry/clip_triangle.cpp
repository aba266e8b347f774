#include "grove/geometry/clip_triangle.h"

#include <cmath>

#include "grove/math/rounding.h"

namespace grove {
namespace {

using DVec3 = glm::dvec3;

struct Polygon {
  DVec3 corners[9];
  int count = 0;
};

// Keeps the half of `polygon` where side * (corner[axis] - plane) >= 0.
Polygon clip_to_plane(const Polygon& polygon, int axis, double plane, double side) {
  Polygon kept;
  for (int i = 0; i < polygon.count; ++i) {
    const DVec3& a = polygon.corners[i];
    const DVec3& b = polygon.corners[(i + 1) % polygon.count];
    const double distance_a = side * (a[axis] - plane);
    const double distance_b = side * (b[axis] - plane);
    if (distance_a >= 0.0) kept.corners[kept.count++] = a;
    if ((distance_a > 0.0 && distance_b < 0.0) || (distance_a < 0.0 && distance_b > 0.0)) {
      DVec3 crossing = a + (b - a) * (distance_a / (distance_a - distance_b));
      crossing[axis] = plane;
      kept.corners[kept.count++] = crossing;
    }
  }
  return kept;
}

}  // namespace

Box clip_triangle(const Vec3& v0, const Vec3& v1, const Vec3& v2, const Box& box) {
  Polygon polygon{{DVec3(v0), DVec3(v1), DVec3(v2)}, 3};
  for (int axis = 0; axis < 3 && polygon.count > 0; ++axis) {
    polygon = clip_to_plane(polygon, axis, box.lower[axis], 1.0);
    polygon = clip_to_plane(polygon, axis, box.upper[axis], -1.0);
  }
  Box result;
  for (int i = 0; i < polygon.count; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const double v = polygon.corners[i][axis];
      result.lower[axis] = std::fmin(result.lower[axis], round_down(v));
      result.upper[axis] = std::fmax(result.upper[axis], round_up(v));
    }
  }
  return result.is_empty() ? Box{} : result.intersection(box);
}

}  // namespace grove
