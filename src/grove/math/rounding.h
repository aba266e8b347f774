#pragma once

#include <cmath>
#include <limits>

namespace grove {

/// The largest float that is not above v.
[[nodiscard]] inline float round_down(double v) {
  const auto f = static_cast<float>(v);
  return f <= v ? f : std::nextafter(f, -std::numeric_limits<float>::infinity());
}

/// The smallest float that is not below v.
[[nodiscard]] inline float round_up(double v) {
  const auto f = static_cast<float>(v);
  return f >= v ? f : std::nextafter(f, std::numeric_limits<float>::infinity());
}

}  // namespace grove
