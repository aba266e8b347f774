#pragma once

#include <algorithm>
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

/// Calls visit(q) for each pixel within `radius` rows and columns of pixel (x, y), and for that itself, row by row.
template <typename Visit>
void for_each_within(const Guides& guides, std::ptrdiff_t x, std::ptrdiff_t y, std::ptrdiff_t radius, const Visit& visit) {
  const auto width = static_cast<std::ptrdiff_t>(guides.width);
  const auto height = static_cast<std::ptrdiff_t>(guides.height);
  for (std::ptrdiff_t qy = std::max<std::ptrdiff_t>(0, y - radius); qy <= std::min(height - 1, y + radius); ++qy)
    for (std::ptrdiff_t qx = std::max<std::ptrdiff_t>(0, x - radius); qx <= std::min(width - 1, x + radius); ++qx)
      visit(static_cast<std::size_t>(qy * width + qx));
}

/// Calls visit(q) for pixel (x, y) itself and each pixel of its surface within `radius` rows and columns, row by row.
template <typename Visit>
void for_each_on_surface(const Guides& guides, std::ptrdiff_t x, std::ptrdiff_t y, std::ptrdiff_t radius, const Visit& visit) {
  const auto width = static_cast<std::ptrdiff_t>(guides.width);
  const auto height = static_cast<std::ptrdiff_t>(guides.height);
  const auto p = static_cast<std::size_t>(y * width + x);
  for (std::ptrdiff_t qy = std::max<std::ptrdiff_t>(0, y - radius); qy <= std::min(height - 1, y + radius); ++qy) {
    for (std::ptrdiff_t qx = std::max<std::ptrdiff_t>(0, x - radius); qx <= std::min(width - 1, x + radius); ++qx) {
      const auto q = static_cast<std::size_t>(qy * width + qx);
      if (q == p || is_same_surface(guides, p, q, static_cast<float>(qx - x), static_cast<float>(qy - y))) visit(q);
    }
  }
}

}  // namespace grove
