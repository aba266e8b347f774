#pragma once

#include "grove/accel/fast_bvh.h"
#include "grove/build/cost_model.h"
#include "grove/geometry/triangle_mesh.h"

namespace grove {

/// What a refit finds.
struct FastRefit {
  double cost =
      0.0;  ///< expected time of a ray: expected_cost, but that boxes on grids are not cut by those above them. Infinity or NaN where boxes have grown beyond all measure
  bool all_hittable = true;  ///< whether every triangle in the hierarchy can still be hit; otherwise it must be built anew
};

/// Measures the boxes of a hierarchy of the fast path anew from the leaves up, and writes the corners of triangles into its blocks where they stand there:
/// `mesh` is the one that it was packed from, with other vertices. The topology stays, and so do the places of children and their order for each octant of direction,
/// which tell how soon a hit is found and not which. Children of compressed nodes are put on a grid anew. O(references), parallel; the same for any
/// number of threads. `Bvh` is FastBvh or CompressedFastBvh.
template <typename Bvh>
FastRefit refit_fast(Bvh& bvh, const TriangleMesh& mesh, const CostModel& model = {});

}  // namespace grove
