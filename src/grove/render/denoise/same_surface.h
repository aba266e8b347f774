#pragma once

#include <cmath>
#include <cstddef>

#include "grove/render/denoise/guides.h"

namespace grove {

/// Whether pixel q, (dx, dy) pixels from p, shows about the surface that p shows: normals within 18 degrees, and a depth as the slope at p leads to expect.
[[nodiscard]] inline bool is_same_surface(const Guides& guides, std::size_t p, std::size_t q, float dx, float dy) {
  constexpr float kLeastCosine = 0.95F;
  constexpr float kDepthTolerance = 0.01F;
  const float cosine =
      guides.normal_x[p] * guides.normal_x[q] + guides.normal_y[p] * guides.normal_y[q] + guides.normal_z[p] * guides.normal_z[q];
  if (!(cosine >= kLeastCosine)) return false;
  const float expected = guides.slope_x[p] * dx + guides.slope_y[p] * dy;
  return std::fabs(guides.depth[q] - guides.depth[p] - expected) <= kDepthTolerance * guides.depth[p] + std::fabs(expected);
}

}  // namespace grove
