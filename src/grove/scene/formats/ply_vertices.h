#pragma once

#include <cstddef>

#include "grove/scene/formats/ply_numbers.h"
#include "grove/scene/read_ply.h"

namespace grove {

/// Reads the rows of the element "vertex" into `mesh`: x y z, and where there are nx ny nz, u v (under their many names) and colours.
/// `reserve` is how many vertices to make room for at once. Throws InputError, also when x, y or z is missing.
void read_ply_vertices(const PlyElement& element, ByteStream& stream, PlyNumbers& numbers, std::size_t reserve, PlyMesh& mesh);

}  // namespace grove
