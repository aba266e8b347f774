#pragma once

#include <cstddef>
#include <cstdint>

#include "grove/base/huge_vector.h"
#include "grove/math/box.h"

namespace grove {

/// What a ray needs in a leaf of a kd-tree to find the next without a stack (Popov, Günther, Seidel and Slusallek 2007, "Stackless KD-Tree Traversal for
/// High Performance GPU Ray Tracing"): the cell, and for each of its faces the smallest node whose cell has the whole face on its border from the other side.
///
///   bytes  0..23  cell
///   bytes 24..47  ropes: node behind the lower x, upper x, lower y, upper y, lower z, upper z face
///   bytes 48..55  first reference, count
///   bytes 56..63  0
struct alignas(64) KdRopedLeaf {
  /// Behind this face there is nothing.
  static constexpr std::uint32_t kOutside = 0xffffffffU;

  Box cell;
  std::uint32_t ropes[6];
  std::uint32_t first;
  std::uint32_t count;
  std::uint32_t unused[2];
};

static_assert(sizeof(KdRopedLeaf) == 64);

/// The ropes of a kd-tree. The leaves of a tree with ropes hold their number in `leaves` in place of their first reference.
struct KdRopes {
  HugeVector<KdRopedLeaf> leaves;

  [[nodiscard]] bool is_empty() const { return leaves.empty(); }
  /// Bytes kept for tracing.
  [[nodiscard]] std::size_t memory() const { return leaves.size() * sizeof(KdRopedLeaf); }
};

}  // namespace grove
