#pragma once

#include "grove/math/vector.h"

namespace grove {

/// Linear scene light to linear display light in [0, 1], by a filmic curve (Narkowicz 2015, "ACES Filmic Tone Mapping Curve", a rational fit
/// to the ACES reference transform), which keeps middle grey in place: colours are scaled before it so that 0.18 gives 0.18.
/// Saturated highlights go to white.
[[nodiscard]] Vec3 tone_map_filmic(const Vec3& colour);

/// Linear in [0, 1] to sRGB-encoded in [0, 1] (IEC 61966-2-1). Values outside are clamped; NaN gives 0.
[[nodiscard]] float encode_srgb(float linear);

}  // namespace grove
