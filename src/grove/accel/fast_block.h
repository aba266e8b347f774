#pragma once

#include <cstdint>
#include <type_traits>

#include "grove/accel/fast_child.h"
#include "grove/math/vector.h"

namespace grove {

/// How many of the ids of a block are different; those of unused places are the first again.
template <std::uint32_t kWidth>
[[nodiscard]] std::uint32_t count_different(const std::uint32_t (&ids)[kWidth]) {
  std::uint32_t count = 1;
  for (std::uint32_t place = 1; place < kWidth; ++place) count += ids[place] != ids[0] ? 1 : 0;
  return count;
}

/// Up to four different triangles by axis, corner and place; the same triangle may stand in other blocks. Unused places repeat the first, which
/// no query can tell: the same hit twice is one. 160 bytes.
struct alignas(32) TriangleBlock {
  static constexpr int kWidth = 4;
  static constexpr std::uint32_t kUnits = 5;

  float corners[3][3][kWidth];
  std::uint32_t primitive[kWidth];

  /// How many triangles there are, 1 to 4.
  [[nodiscard]] std::uint32_t count() const { return count_different(primitive); }
};

static_assert(sizeof(TriangleBlock) == TriangleBlock::kUnits * sizeof(FastUnit));

/// The same with the corners by their numbers in the mesh, in one cache line.
struct alignas(64) IndexedBlock {
  static constexpr int kWidth = TriangleBlock::kWidth;
  static constexpr std::uint32_t kUnits = 2;

  std::uint32_t vertex[3][kWidth];
  std::uint32_t primitive[kWidth];

  [[nodiscard]] std::uint32_t count() const { return count_different(primitive); }
};

static_assert(sizeof(IndexedBlock) == IndexedBlock::kUnits * sizeof(FastUnit));

/// The triangles of a block, to be read where they are.
[[nodiscard]] inline const TriangleBlock& gathered(const TriangleBlock& block, const Vec3* /*vertices*/) {
  return block;
}

/// The triangles that the block names among the vertices of its mesh.
[[nodiscard]] inline TriangleBlock gathered(const IndexedBlock& block, const Vec3* vertices) {
  TriangleBlock triangles;
  for (int place = 0; place < TriangleBlock::kWidth; ++place) {
    for (int corner = 0; corner < 3; ++corner) {
      const Vec3& vertex = vertices[block.vertex[corner][place]];
      for (int axis = 0; axis < 3; ++axis) triangles.corners[axis][corner][place] = vertex[axis];
    }
    triangles.primitive[place] = block.primitive[place];
  }
  return triangles;
}

}  // namespace grove
