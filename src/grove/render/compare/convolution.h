#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace grove {

/// One number for each pixel, row by row from the top.
using Plane = std::vector<float>;

/// Weights of the places -radius to radius.
struct Kernel {
  std::vector<float> weights;  ///< 2 radius + 1

  explicit Kernel(int radius) : weights(2 * static_cast<std::size_t>(radius) + 1, 0.0F) {}

  [[nodiscard]] int radius() const { return static_cast<int>(weights.size() / 2); }
  [[nodiscard]] float& at(int place) { return weights[static_cast<std::size_t>(place + radius())]; }
  [[nodiscard]] float at(int place) const { return weights[static_cast<std::size_t>(place + radius())]; }
  [[nodiscard]] float sum() const;
  void scale(float factor);
};

/// Weights a pixel's surroundings by across(x) down(y); pixels beyond an edge are as those at it. In parallel by rows; O(pixels radius).
[[nodiscard]] Plane convolve(const Plane& plane, std::uint32_t width, std::uint32_t height, const Kernel& across, const Kernel& down);

}  // namespace grove
