#pragma once

// The planes of octree-R (Whang et al. 1995): across each axis, where the fewest tests are expected (octree_r_cost.h). The best plane lies between the
// spatial median and the object median (MacDonald and Booth 1990), so the paper tries some that are spaced equally between the two. Beside that: all planes in
// which a primitive begins or ends, which are all that can be best; and the three planes chosen together, by the tests expected in eight octants, where the
// paper takes each axis for itself.

#include <cstdint>
#include <span>
#include <vector>

#include "grove/build/octree/octree_settings.h"
#include "grove/build/octree/part_octants.h"

namespace grove {

/// Chooses by the bounds of primitives. One that only touches a plane, or lies in it, counts to one side only, as the builder puts it.
class OctreeRPlanes {
 public:
  struct Scratch {
    std::vector<float> ends[3];
    std::vector<std::uint32_t> grids[8];
  };

  OctreeRPlanes(OctreeRSearch search, std::uint32_t candidate_count) : search_(search), candidate_count_(candidate_count) {}

  /// O(n candidates), O(n log n) for OctreeRSearch::events, O(n + candidates^3) for OctreeRSearch::joint. In parallel for large sets, but for the
  /// counts of joint candidates; the same for any number of threads.
  [[nodiscard]] OctantCut choose(const OctantSource& source, const Box4& cell, std::span<const std::uint32_t> ids, Scratch& scratch) const;

  /// Of OctreeRSearch::joint, which counts in a grid of all their triples.
  static constexpr std::uint32_t kMostJointCandidates = 16;

 private:
  OctreeRSearch search_;
  std::uint32_t candidate_count_;
};

}  // namespace grove
