#pragma once

#include "grove/math/vector.h"

// The colour spaces that FLIP works in. Colours in are linear, Rec. 709 primaries and white (D65).

namespace grove {

/// YCxCz, the linear cousin of CIELAB: achromatic, red to green, blue to yellow.
[[nodiscard]] Vec3 to_ycxcz(const Vec3& colour);
[[nodiscard]] Vec3 from_ycxcz(const Vec3& ycxcz);

/// CIELAB with its two chromatic axes scaled by lightness, after Hunt: colourfulness grows with luminance.
[[nodiscard]] Vec3 to_hunt_lab(const Vec3& colour);

/// HyAB, the distance for large differences (Abasi, Amani Tehran, Fairchild 2020, "Distance metrics for very large color differences"): city-block between
/// lightness and chroma, Euclidean within chroma.
[[nodiscard]] float hyab(const Vec3& a, const Vec3& b);

}  // namespace grove
