#pragma once

#include "grove/render/denoise/guides.h"
#include "grove/render/denoise/history.h"
#include "grove/render/layers/first_hits.h"

namespace grove {

/// What the history holds of the surface that pixel (x, y) shows now: the pixels round the place where it was before, by bilinear weights, as far as they showed the same surface: same part of the
/// same instance, a depth within 2 % of where the surface was, a normal within 25 degrees. Where none of the four did, the nearest of the 3 x 3 that did. A sample_count of 0 says
/// that the surface was hidden or outside of the picture. O(1).
[[nodiscard]] PixelHistory reprojected(const FrameHistory& history, const FirstHit& hit, const Guides& guides, std::uint32_t x,
                                       std::uint32_t y);

}  // namespace grove
