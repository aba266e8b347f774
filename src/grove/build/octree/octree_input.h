#pragma once

// What building an octree and bringing one up to date have in common.

#include <cstdint>

#include "grove/build/octree/middle_planes.h"
#include "grove/build/octree/octree_builder.h"
#include "grove/build/octree/octree_r_planes.h"

namespace grove {

/// The primitives and limits of one build. `list` must not be empty.
struct OctreeInput {
  OctreeInput(ReferenceList list, const OverlapTest& overlap_test, const OctreeSettings& settings);

  Box bounds;
  Box cell;                       ///< of the root: around the bounds; for octree-R, whose planes go by costs, of their form, else a cube
  HugeVector<std::uint32_t> ids;  ///< of what can be hit, ascending
  HugeVector<PrimitiveReference> references;  ///< by primitive
  OctantSource source;
  std::uint32_t most_depth;
  std::uint64_t capacity;  ///< most references

  OctreeInput(const OctreeInput&) = delete;
  OctreeInput& operator=(const OctreeInput&) = delete;

  [[nodiscard]] OctreeCell root(const Box& root_cell) const {
    return {{to_float4(root_cell.lower), to_float4(root_cell.upper)}, 0, capacity, 0};
  }
};

/// Calls body(builder) with the planes that the settings ask for.
template <typename Body>
auto with_octree_builder(const OctreeInput& input, const OctreeSettings& settings, const Body& body) {
  if (settings.split == OctreeSplit::median) {
    const MiddlePlanes planes;
    return body(OctreeBuilder(planes, input.source, settings, input.most_depth));
  }
  const OctreeRPlanes planes(settings.search, settings.candidate_count);
  return body(OctreeBuilder(planes, input.source, settings, input.most_depth));
}

}  // namespace grove
