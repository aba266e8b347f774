#pragma once

#include "grove/render/compare/convolution.h"
#include "grove/render/image/colour_image.h"

namespace grove {

/// How large a pixel looks: pixels in one degree of the field of view. The default is the papers': a screen of 3840 pixels across 0.7 m, seen from 0.7 m.
inline constexpr float kFlipPixelsPerDegree = 67.02064F;

/// The difference that a person sees who flips between two pictures, for each pixel from 0 (none) to 1: LDR-FLIP (Andersson, Nilsson, Akenine-Möller,
/// Oskarsson, Åström, Fairchild 2020, "FLIP: A Difference Evaluator for Alternating Images"). Colours are blurred as the eye's contrast sensitivity does, compared in a
/// uniform colour space, and the difference is raised where edges or points differ. Colours are linear display light; what is outside of [0, 1] is cut.
/// The pictures must be of one size. O(pixels pixels_per_degree); in parallel in the caller's arena, with the same result for any number of threads.
[[nodiscard]] Plane flip(const ColourImage& reference, const ColourImage& test, float pixels_per_degree = kFlipPixelsPerDegree);

/// The same for light without an upper limit.
struct HdrFlip {
  Plane difference;      ///< for each pixel the largest LDR-FLIP over all exposures
  float first_exposure;  ///< in stops: where the brightest of the reference just shows detail
  float last_exposure;   ///< where the median of the reference is as bright
  int exposures;
};

/// HDR-FLIP (Andersson, Nilsson, Shirley, Akenine-Möller 2021, "Visualizing Errors in Rendered High Dynamic Range Images"): LDR-FLIP at exposures from the one at which
/// the reference's brightest pixel to the one at which its median comes to 0.85 of white through the paper's tone map, a stop or less apart.
[[nodiscard]] HdrFlip hdr_flip(const ColourImage& reference, const ColourImage& test, float pixels_per_degree = kFlipPixelsPerDegree);

}  // namespace grove
