#pragma once

// The same hierarchy in other volumes: around the primitives below each box of a binary hierarchy a volume is fitted (build/volumes), and the
// areas of the volumes decide which boxes become children and which become leaves (build/passes/collapse.h). So volumes are compared on one
// topology, each with the leaves that suit it.

#include "grove/accel/volume_bvh.h"
#include "grove/build/passes/collapse.h"
#include "grove/build/volumes/hulls.h"

namespace grove {

/// `hulls` are those of `bvh.references`, in that order; `bvh` must be in depth-first order. Where leaves hold one reference each, volumes decide
/// all leaves. Where primitives were cut to pieces, a volume encloses the whole primitives or the box of the pieces, whichever is smaller. The
/// same for any number of threads. Each level of the hierarchy goes over the hulls once or, for spheres, up to three times: O(n log n) where
/// it is balanced and never more than O(n Bvh2::kMaxDepth).
template <BoundingVolume V>
[[nodiscard]] VolumeBvh<V> rebound(const Bvh2& bvh, const HullList& hulls, const CollapseSettings& settings);

}  // namespace grove
