#pragma once

#include <cstdint>

#include "grove/accel/fast_block.h"
#include "grove/geometry/triangle_mesh.h"

namespace grove {

/// Writes the corners of a triangle, as the mesh has them now, into a place of a block.
inline void put_corners(const TriangleMesh& mesh, std::uint32_t primitive, int place, TriangleBlock& block) {
  const Triangle& triangle = mesh.triangles()[primitive];
  for (int corner = 0; corner < 3; ++corner)
    for (int axis = 0; axis < 3; ++axis) block.corners[axis][corner][place] = mesh.vertices()[triangle[corner]][axis];
}

/// The same where corners are numbers of vertices.
inline void put_corners(const TriangleMesh& mesh, std::uint32_t primitive, int place, IndexedBlock& block) {
  for (int corner = 0; corner < 3; ++corner) block.vertex[corner][place] = mesh.triangles()[primitive][corner];
}

}  // namespace grove
