#pragma once

// Planes between the medians of a cell, which octree-R tries.

#include <cstdint>
#include <span>
#include <vector>

#include "grove/build/octree/part_octants.h"

namespace grove {

/// A cell's references.
struct CellSet {
  const OctantSource& source;
  std::span<const std::uint32_t> ids;

  [[nodiscard]] std::size_t size() const { return ids.size(); }
  [[nodiscard]] const PrimitiveReference& operator[](std::size_t i) const { return source.references[ids[i]]; }
};

/// Candidates of all axes, side by side in the lanes: for each axis counts[axis] planes in ascending order, all inside the cell, and then NaN.
struct OctreeRCandidates {
  std::vector<Float4> planes;
  std::size_t counts[3] = {0, 0, 0};

  /// At most `count` for each axis, spaced equally between the spatial median and the object median, both included; a single one lies half way.
  /// `ends` is memory to work in. In parallel for large sets. O(n + count).
  OctreeRCandidates(const CellSet& set, const Box4& cell, std::uint32_t count, std::vector<float> ends[3]);
};

/// Where as many primitives are below as above: half of their begins and ends, as far as they lie in the cell. O(n).
[[nodiscard]] float object_median(const CellSet& set, const Box4& cell, int axis, std::vector<float>& ends);

}  // namespace grove
