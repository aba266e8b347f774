#pragma once

#include <cstdint>

#include "grove/accel/octree.h"

namespace grove {

/// Where a primitive is referenced.
enum class OctreeStore : std::uint8_t {
  leaf,   ///< in each leaf that it truly overlaps
  inner,  ///< once, in the smallest node whose cell encloses its bounds
};

struct OctreeSettings {
  OctreeStore store = OctreeStore::leaf;
  /// No leaf is deeper; 0 for (8 + 1.3 log2 n) / 3, which is as fine as a kd-tree's default. At most Octree::kMaxDepth.
  std::uint32_t most_depth = 0;
  /// Sets of at most this many primitives are not cut. At least 1.
  std::uint32_t leaf_size = 8;
  /// At most so many references are made, as a multiple of the primitives. At least 1.
  double most_references = 8.0;
};

}  // namespace grove
