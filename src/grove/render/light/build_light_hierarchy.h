#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "grove/render/light/light_bounds.h"
#include "grove/render/light/light_cluster.h"

namespace grove {

struct BuiltLightHierarchy {
  std::vector<LightCluster> nodes;
  std::vector<std::uint64_t> trails;
};

/// Builds the tree of a LightHierarchy from the root down by the surface area orientation heuristic (Conty Estevez and Kulla 2018, section 4.2), over bins
/// of centres along all three axes. Sets that no plane parts, and those that would come too deep, are halved. Lights that are left out get
/// `no_trail`. `most_depth` at most 63. The same result for any number of threads.
[[nodiscard]] BuiltLightHierarchy build_light_hierarchy(std::span<const LightBounds> lights, std::uint32_t most_depth,
                                                        std::uint64_t no_trail);

}  // namespace grove
