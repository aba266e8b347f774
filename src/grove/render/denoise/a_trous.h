#pragma once

#include "grove/render/denoise/guides.h"
#include "grove/render/denoise/illumination.h"

namespace grove {

/// How readily the filter mixes pixels. The defaults are the paper's but for what measurements on the scenes of docs/rendering.md chose.
struct FilterSettings {
  /// Passes; each reaches twice as far as the one before, the last 2^passes pixels.
  int passes = 5;
  /// Differences of depth that are let through, in multiples of what the surface's slope explains.
  float depth_slack = 1.0F;
  /// Differences of luminance that are let through, in standard deviations of the noise.
  float luminance_slack = 4.0F;
};

/// The spatial filter of SVGF (Schied, Kaplanyan, Wyman, Patney, Chaitanya, Burgess, Liu, Dachsbacher, Lefohn, Salvi 2017, "Spatiotemporal Variance-Guided Filtering:
/// Real-Time Reconstruction for Path-Traced Global Illumination", section 4.3): an edge-avoiding à-trous wavelet transform (Dammertz, Sewtz, Hanika, Lensch 2010) whose
/// edge-stopping functions are depth against its slope, normals to the power of 128, and luminance against its standard deviation. So what is sure
/// stays as it is: with a variance of 0 only pixels of equal luminance are mixed. The variance is filtered along.
///
/// O(pixels passes): 25 taps each. In parallel by rows in the caller's arena, with the same result for any number of threads.
[[nodiscard]] Illumination filter_a_trous(Illumination light, const Guides& guides, const FilterSettings& settings = {});

}  // namespace grove
