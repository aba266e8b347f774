#pragma once

#include "grove/build/octree/octree_r_candidates.h"

namespace grove {

/// Of all triples of candidates, one for each axis, the one with the fewest tests expected in the eight octants (equation 8 for eight parts), by the bounds
/// of primitives. Axes without candidates are not cut. `grids` is memory to work in. O(n + product of the candidates' counts).
[[nodiscard]] OctantCut choose_jointly(const CellSet& set, const Box4& cell, const OctreeRCandidates& candidates,
                                       std::vector<std::uint32_t> grids[8]);

}  // namespace grove
