#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "grove/math/vector.h"

namespace grove {

inline constexpr std::uint32_t kNoObjIndex = 0xffffffffU;

/// One corner of a face: indices from 0, kNoObjIndex where the file gives none.
struct ObjCorner {
  std::uint32_t position = kNoObjIndex;
  std::uint32_t uv = kNoObjIndex;
  std::uint32_t normal = kNoObjIndex;

  friend bool operator==(const ObjCorner&, const ObjCorner&) = default;
};

/// The triangles of one shape that have one material.
struct ObjPart {
  std::string shape;
  std::string material;  ///< empty before the first usemtl
  std::vector<std::array<ObjCorner, 3>> triangles;
};

/// The geometry of an OBJ file, triangulated, all indices in range.
struct ObjFile {
  std::vector<Vec3> positions;
  std::vector<Vec4> colours;  ///< one a position when any vertex has a colour (x y z r g b), otherwise empty
  std::vector<Vec2> uvs;
  std::vector<Vec3> normals;
  std::vector<ObjPart> parts;  ///< in the order first met
  std::vector<std::string> material_libraries;
  std::vector<std::string> ignored;  ///< keywords whose lines were left out, each once
};

/// Reads v, vt, vn, f, o, g, usemtl and mtllib of a Wavefront OBJ file. Indices count from 1 or back from the end; they must name what came
/// before. Coordinates that are no finite numbers (nan, inf, 1.#IND) are kept as such. Throws InputError naming the line.
[[nodiscard]] ObjFile parse_obj(const std::filesystem::path& file);

}  // namespace grove
