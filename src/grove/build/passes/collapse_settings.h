#pragma once

#include <cstdint>

#include "grove/build/cost_model.h"

namespace grove {

enum class Widening : std::uint8_t { optimal, greedy };

struct CollapseSettings {
  static constexpr int kMaxArity = 8;

  int arity = 2;  ///< most children of a node, 2 to kMaxArity
  std::uint32_t leaf_size = 8;
  Widening widening = Widening::optimal;
  CostModel cost = {};

  [[nodiscard]] float leaf_time(std::uint32_t count) const {
    return static_cast<float>(cost.intersection) * static_cast<float>(cost.in_whole_blocks(count));
  }
};

}  // namespace grove
