#pragma once

#include <vector>

#include "grove/math/vector.h"
#include "grove/scene/pbrt/transforms.h"

namespace grove::pbrt {

/// The triangles of one shape. Normals, texture coordinates and tangents are empty or have one entry a vertex.
struct ShapeMesh {
  std::vector<Vec3> vertices;
  std::vector<Vec3> normals;
  std::vector<Vec2> uvs;
  std::vector<Vec4> tangents;
  std::vector<Triangle> triangles;
};

/// A point of a parametric surface.
struct SurfacePoint {
  Vec3 position{0.0F};
  Vec3 normal{0.0F};
  Vec2 uv{0.0F};
};

/// Adds triangles over a grid of (columns + 1) x (rows + 1) surface points, u running along a row; they face the side of du x dv. Triangles
/// with two equal corners (at a pole) are left out. `surface(i, j)` gives the point of column i and row j.
template <typename Surface>
void append_grid(ShapeMesh& mesh, std::uint32_t columns, std::uint32_t rows, const Surface& surface) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (std::uint32_t j = 0; j <= rows; ++j) {
    for (std::uint32_t i = 0; i <= columns; ++i) {
      const SurfacePoint point = surface(i, j);
      mesh.vertices.push_back(point.position);
      mesh.normals.push_back(point.normal);
      mesh.uvs.push_back(point.uv);
    }
  }
  const auto append = [&mesh](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto& v = mesh.vertices;
    if (v[a] != v[b] && v[b] != v[c] && v[c] != v[a]) mesh.triangles.emplace_back(a, b, c);
  };
  for (std::uint32_t j = 0; j < rows; ++j) {
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t corner = first + j * (columns + 1) + i;
      append(corner, corner + 1, corner + columns + 2);
      append(corner, corner + columns + 2, corner + columns + 1);
    }
  }
}

/// Takes the mesh through `to_world`. As in pbrt a triangle faces the side of its winding in the space where it was given, the other side
/// with `reverse_orientation`, and where there are vertex normals (which `reverse_orientation` turns over) the side that they
/// are on. The triangles are rewound so that their winding in world space says the same.
void place_mesh(ShapeMesh& mesh, const Matrix& to_world, bool reverse_orientation);

/// Gives each triangle the texture coordinates (0, 0), (1, 0), (1, 1) that pbrt assumes; vertices are no longer shared then. Nothing
/// happens where there are texture coordinates.
void add_default_uvs(ShapeMesh& mesh);

}  // namespace grove::pbrt
