#pragma once

#include "grove/accel/fast_bvh.h"
#include "grove/accel/wide_bvh.h"
#include "grove/geometry/triangle_mesh.h"

namespace grove {

/// Lays a wide hierarchy out for the fast path: the same nodes, with their children's orders for the eight octants of direction, and the triangles of
/// each leaf in a block. Leaves must hold at most TriangleBlock::kWidth references. O(n), parallel; the same for any number of threads.
/// `Bvh` is FastBvh or CompressedFastBvh.
template <typename Bvh>
[[nodiscard]] Bvh pack_fast(const WideBvh<8>& bvh, const TriangleMesh& mesh);

}  // namespace grove
