#pragma once

#include "grove/accel/bvh2.h"
#include "grove/accel/fast_bvh.h"
#include "grove/build/passes/collapse_settings.h"
#include "grove/geometry/triangle_mesh.h"

namespace grove {

/// Collapses a binary hierarchy to eight children a node (settings.arity is taken as that) and lays it out for the fast path: nodes with their
/// children's orders for the eight octants of direction, and the triangles of each leaf in a block. `binary` must be in depth-first order, and its leaves
/// and settings.leaf_size at most TriangleBlock::kWidth. O(n), parallel; the same for any number of threads. Memory beside the result: about 5 bytes a
/// triangle. `Bvh` is FastBvh or CompressedFastBvh.
template <typename Bvh>
[[nodiscard]] Bvh pack_fast(const Bvh2& binary, const TriangleMesh& mesh, const CollapseSettings& settings);

}  // namespace grove
