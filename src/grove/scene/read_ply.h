#pragma once

#include <filesystem>
#include <vector>

#include "grove/math/vector.h"

namespace grove {

/// The mesh of a PLY file. `normals`, `uvs` and `colours` are empty or have one entry a vertex.
struct PlyMesh {
  std::vector<Vec3> vertices;
  std::vector<Vec3> normals;
  std::vector<Vec2> uvs;
  std::vector<Vec4> colours;  ///< linear
  std::vector<Triangle> triangles;
};

/// Reads ASCII and binary (both byte orders) PLY, plain or gzip-compressed (told from the content); polygons are triangulated.
/// Counts in the header are checked against the bytes that are there before memory is asked for. Throws InputError naming the file
/// and the line or byte.
[[nodiscard]] PlyMesh read_ply(const std::filesystem::path& file);

}  // namespace grove
