#pragma once

#include "grove/accel/octree.h"
#include "grove/build/octree/octant_test.h"
#include "grove/build/octree/octree_settings.h"

namespace grove {

/// Builds an octree from the root down, in parallel in the caller's oneTBB arena; the result is the same, bit for bit, for any number of threads. Depth,
/// time and the number of references are bounded for any input: sets that planes do not part become leaves, however large. O(n log n) with n the
/// references. Throws InputError where the tree would be larger than its numbers allow.
[[nodiscard]] Octree build_octree(ReferenceList list, const OverlapTest& overlap, const OctreeSettings& settings);

/// The same over a geometry.
template <Geometry G>
[[nodiscard]] Octree build_octree(const G& geometry, const OctreeSettings& settings) {
  return build_octree(list_references(geometry), GeometryOverlapTest<G>(geometry), settings);
}

}  // namespace grove
