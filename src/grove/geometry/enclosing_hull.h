#pragma once

// What a volume must enclose to enclose a primitive: the one thing that the fitting of volumes needs to know of a geometry.

#include <concepts>
#include <cstddef>

#include "grove/geometry/geometry_concept.h"
#include "grove/geometry/sphere_set.h"
#include "grove/geometry/triangle_mesh.h"

namespace grove {

/// The convex hull of kCount points, grown by a radius on all sides.
template <int kCount>
struct EnclosingHull {
  static constexpr int kPointCount = kCount;

  Vec3 points[kCount];
  float radius = 0.0F;
};

/// The triangle itself.
[[nodiscard]] inline EnclosingHull<3> enclosing_hull(const TriangleMesh& mesh, std::size_t i) {
  const Triangle& triangle = mesh.triangles()[i];
  return {{mesh.vertices()[triangle.x], mesh.vertices()[triangle.y], mesh.vertices()[triangle.z]}};
}

/// The sphere itself.
[[nodiscard]] inline EnclosingHull<1> enclosing_hull(const SphereSet& set, std::size_t i) {
  return {{set.sphere(i).centre}, set.sphere(i).radius};
}

/// Of any other geometry, the corners of the bounds. So also of instances: their rays are cut to the world bounds, which are therefore safe,
/// while a hit may lie outside the transformed corners of the object by the rounding of the ray into object space, however far that is.
template <Geometry G>
[[nodiscard]] EnclosingHull<8> enclosing_hull(const G& geometry, std::size_t i) {
  const Box box = geometry.bounds(i);
  EnclosingHull<8> hull;
  for (int corner = 0; corner < 8; ++corner) {
    hull.points[corner] = {(corner & 1) != 0 ? box.upper.x : box.lower.x, (corner & 2) != 0 ? box.upper.y : box.lower.y,
                           (corner & 4) != 0 ? box.upper.z : box.lower.z};
  }
  return hull;
}

/// A geometry around whose primitives volumes can be fitted. Every geometry is: those without a hull of their own have that of their bounds.
template <typename G>
concept EnclosableGeometry = Geometry<G> && requires(const G& geometry, std::size_t i) {
  { enclosing_hull(geometry, i).points[0] } -> std::convertible_to<Vec3>;
  { enclosing_hull(geometry, i).radius } -> std::convertible_to<float>;
};

}  // namespace grove
