#pragma once

#include <optional>
#include <span>

#include "grove/accel/octree.h"
#include "grove/build/octree/octant_test.h"
#include "grove/build/octree/octree_settings.h"

namespace grove {

/// An octree after primitives `changed` have been added, removed or moved, made from the one before without building it anew: they are taken out of the leaves
/// and nodes that they were in, and put in where they are now. Cells with too many primitives are cut, nodes with too few become leaves; all else, planes among it,
/// stays. Where the root's cell and the depth limit are those of a new tree and the limit of references is far, an octree cut in the middle comes out
/// as if built anew, bit for bit. `list` has all primitives as they are now, `settings` are those of the tree.
///
/// Nothing where the root's cell does not fit any more (something is outside, or it is more than twice too large), or there would be too many
/// references: then it takes a new tree. In parallel in the caller's oneTBB arena; the same for any number of threads. O(n + nodes + references) copying, and
/// building for what has changed.
[[nodiscard]] std::optional<Octree> update_octree(const Octree& tree, ReferenceList list, const OverlapTest& overlap,
                                                  const OctreeSettings& settings, std::span<const std::uint32_t> changed);

/// The same over a geometry.
template <Geometry G>
[[nodiscard]] std::optional<Octree> update_octree(const Octree& tree, const G& geometry, const OctreeSettings& settings,
                                                  std::span<const std::uint32_t> changed) {
  return update_octree(tree, list_references(geometry), GeometryOverlapTest<G>(geometry), settings, changed);
}

}  // namespace grove
