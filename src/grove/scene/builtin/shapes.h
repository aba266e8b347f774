#pragma once

#include <cstdint>
#include <span>

#include "grove/scene/builtin/scene_builder.h"

namespace grove {

/// A parallelogram cut into `cells` * `cells` squares of two triangles each: 2 * cells^2. Its normal is cross(edge_u, edge_v);
/// u and v run from 0 to 1 along the edges.
void add_grid(PartMesh& mesh, const Vec3& corner, const Vec3& edge_u, const Vec3& edge_v, std::uint32_t cells);

/// A square in the plane y = `height`, facing up, of two triangles.
void add_ground(PartMesh& mesh, const Vec3& centre, float half_width);

/// Number of triangles of a geodesic sphere: 20 * 4^level.
[[nodiscard]] constexpr std::uint64_t geodesic_triangles(std::uint32_t level) {
  return std::uint64_t{20} << (2 * level);
}

/// The unit geodesic sphere: an icosahedron whose triangles are cut in four `level` <= 8 times. Its vertices are its normals.
[[nodiscard]] PartMesh geodesic_sphere(std::uint32_t level);

/// Adds a copy of `sphere` for each of `spheres`.
void add_spheres(PartMesh& mesh, const PartMesh& sphere, std::span<const SphereSet::Sphere> spheres);

/// A tube of round cross-section around a closed or open centre line; the frame of each ring is carried along the line (parallel transport), so
/// that it does not twist. `closed`: the last ring joins the first, 2 * centres * sides triangles; otherwise 2 * (centres - 1) * sides.
struct Tube {
  std::span<const Vec3> centres;
  std::span<const float> radii;  ///< one for each centre
  std::uint32_t sides = 8;
  bool closed = false;
};
void add_tube(PartMesh& mesh, const Tube& tube);

/// Unit vectors at right angles to the unit vector `axis` and to each other.
struct Frame {
  Vec3 x;
  Vec3 y;
};
[[nodiscard]] Frame frame_around(const Vec3& axis);

/// cos and sin of `turns` full turns, computed in double and rounded once.
[[nodiscard]] Vec2 unit_circle(double turns);

}  // namespace grove
