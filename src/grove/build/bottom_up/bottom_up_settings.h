#pragma once

#include <cstdint>

#include "grove/build/cost_model.h"

namespace grove {

struct BottomUpSettings {
  /// Subtrees of at most this many references may become leaves; they do where that costs no more. At least 1.
  std::uint32_t leaf_size = 8;
  CostModel cost = {};
  /// PLOC only: how far along the Morton curve a cluster looks for its nearest neighbour, in clusters.
  std::uint32_t radius = 8;
};

}  // namespace grove
