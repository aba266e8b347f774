#pragma once

#include <string>
#include <vector>

#include "grove/registry/registry.h"

namespace grove::test {

/// A geometry that the structure matrix is run on.
struct NamedGeometry {
  std::string name;
  GeometryPointer geometry;
};

/// Geometries of all types, ordinary and adversarial: empty, single, degenerate, duplicate, coplanar, huge, tiny, not finite.
/// The same for the same seed.
[[nodiscard]] std::vector<NamedGeometry> matrix_geometries();

/// `triangle_count` random triangles in the unit cube with edges of about `size`.
[[nodiscard]] TriangleMesh random_triangles(std::size_t triangle_count, float size, std::uint64_t seed);

/// A closed sphere-like mesh of 8 * 4^level triangles around the origin, radius about 1, its vertices moved by a little noise.
[[nodiscard]] TriangleMesh closed_mesh(int level, float noise, std::uint64_t seed);

/// A geometry's primitives by number, for aiming rays.
[[nodiscard]] std::size_t size_of(const GeometryPointer& geometry);
[[nodiscard]] Box bounds_of(const GeometryPointer& geometry, std::size_t i);

}  // namespace grove::test
