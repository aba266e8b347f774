#pragma once

#include <limits>

namespace grove {

/// A double as the nearest float; beyond the range of float an infinity (where a plain cast is undefined).
[[nodiscard]] inline float to_float(double value) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  if (value > kLargest) return std::numeric_limits<float>::infinity();
  if (value < -kLargest) return -std::numeric_limits<float>::infinity();
  return static_cast<float>(value);
}

}  // namespace grove
