#pragma once

#include <span>
#include <vector>

#include "grove/render/denoise/guides.h"
#include "grove/render/denoise/illumination.h"

namespace grove {

/// What a pixel's own samples tell of the variance of its luminance.
struct MeasuredNoise {
  float variance = 0.0F;
  bool is_known = false;  ///< there were samples enough to tell
  bool is_pure = false;   ///< it is all noise: none of it comes from how much of a light the pixel shows
};

/// Fills in the variance of `light`. As what a pixel's samples tell is noisier than the light itself, and lowest just where a bright sample is missing, it is averaged over the same
/// surface within 7 x 7 pixels, those where it is pure if there are any. Where none was measured, the spread of their luminances stands for it (section 4.2 of SVGF; see
/// denoise/a_trous.h). O(pixels); in parallel in the caller's arena.
void estimate_noise(std::span<const MeasuredNoise> measured, const Guides& guides, Illumination& light);

}  // namespace grove
