#include "grove/math/rounding.h"

#include <cmath>
#include <limits>

namespace grove {

// Not inline: where GCC 12 makes vectors of neighbouring lines, it takes a double that was rounded to a float and back for the double it was
// before, and the comparisons here would always hold.

float round_down(double v) {
  const auto f = static_cast<float>(v);
  return f <= v ? f : std::nextafter(f, -std::numeric_limits<float>::infinity());
}

float round_up(double v) {
  const auto f = static_cast<float>(v);
  return f >= v ? f : std::nextafter(f, std::numeric_limits<float>::infinity());
}

}  // namespace grove
