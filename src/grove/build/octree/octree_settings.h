#pragma once

#include <cstdint>

#include "grove/accel/octree.h"
#include "grove/build/cost_model.h"

namespace grove {

/// Where cells are cut.
enum class OctreeSplit : std::uint8_t {
  median,    ///< in the middle; until leaves are small or deep enough
  octree_r,  ///< where the fewest tests are expected (Whang et al. 1995); until that costs more than it saves
};

/// Which planes octree-R tries.
enum class OctreeRSearch : std::uint8_t {
  candidates,  ///< a few that are spaced equally between the object median and the spatial median, for each axis on its own
  events,      ///< all in which a primitive begins or ends, for each axis on its own
  joint,       ///< the candidates of all three axes together
};

/// How threads share the work. The tree is the same.
enum class OctreeBuild : std::uint8_t {
  subtree,  ///< from the root down, octants by different threads
  merge,  ///< subsets of the primitives build octrees, which are merged; only where planes do not depend on the primitives, else as `subtree`
};

/// Where a primitive is referenced.
enum class OctreeStore : std::uint8_t {
  leaf,   ///< in each leaf that it truly overlaps
  inner,  ///< once, in the smallest node whose cell encloses its bounds
};

struct OctreeSettings {
  OctreeSplit split = OctreeSplit::median;
  OctreeStore store = OctreeStore::leaf;
  OctreeBuild build = OctreeBuild::subtree;
  /// No leaf is deeper; 0 for (8 + 1.3 log2 n) / 3, which is as fine as a kd-tree's default. At most Octree::kMaxDepth.
  std::uint32_t most_depth = 0;
  /// Sets of at most this many primitives are not cut; 0 for 8, and for octree-R, where the cost decides, for 1.
  std::uint32_t leaf_size = 0;
  /// For octree-R: what is tried, and how many planes for each axis (at most OctreeRPlanes::kMostJointCandidates together). At least 1.
  OctreeRSearch search = OctreeRSearch::candidates;
  std::uint32_t candidate_count = 8;
  /// For octree-R: what a step and a test cost, and how many cuts above each other may cost more than not cutting at all, in the hope of better ones below.
  /// Fitting equation 5 gives tests of 0.21 to 0.27 of a step for spheres and 0.07 to 0.08 for triangles; trees built with 0.2 trace within a tenth of the
  /// fastest for both (docs/octree.md).
  CostModel cost = {.traversal = 1.0, .intersection = 0.2};
  std::uint32_t bad_cuts = 1;
  /// At most so many references are made, as a multiple of the primitives. At least 1.
  double most_references = 8.0;

  [[nodiscard]] std::uint32_t largest_leaf() const { return leaf_size > 0 ? leaf_size : split == OctreeSplit::median ? 8 : 1; }
};

}  // namespace grove
