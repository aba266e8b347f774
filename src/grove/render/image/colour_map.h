#pragma once

#include "grove/math/vector.h"

namespace grove {

/// A colour for a value in [0, 1] (clamped; NaN as 0), sRGB-encoded: from near black over violet, red and orange to pale yellow.
/// Equal steps of the value are equal steps of lightness in Oklab (Ottosson 2020), so that no band looks like an edge that is not there.
[[nodiscard]] Vec3 colour_map(float value);

}  // namespace grove
