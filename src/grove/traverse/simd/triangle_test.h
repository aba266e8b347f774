#pragma once

#include <cstdint>

namespace grove {

/// How the kernels of the fast path test triangles.
enum class TriangleTest : std::uint8_t {
  watertight,  ///< as every other structure: no ray passes between triangles that share an edge, and hits are the same, bit for bit
  fast,        ///< in floats alone: distances and places differ by rounding, and a ray through an edge may miss both sides
};

}  // namespace grove
