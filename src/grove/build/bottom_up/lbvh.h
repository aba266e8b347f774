#pragma once

// The linear hierarchy: Lauterbach, Garland, Sengupta, Luebke, Manocha, "Fast BVH Construction on GPUs" (2009). References are sorted along the
// Morton curve and parted where the highest bit of their codes changes, so building is sorting. Equal codes are halved. Leaves are decided by
// cost on the way back up, unlike in the paper.

#include "grove/accel/bvh2.h"
#include "grove/build/bottom_up/bottom_up_settings.h"
#include "grove/build/primitive_reference.h"

namespace grove {

/// O(n log n) time; depth at most 63 + 31; the same for any number of threads. `settings.radius` is not used.
[[nodiscard]] Bvh2 build_lbvh(const ReferenceList& list, const BottomUpSettings& settings);

}  // namespace grove
