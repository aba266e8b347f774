#include "grove/render/compare/convolution.h"

#include <algorithm>

#include "grove/base/parallel.h"

namespace grove {

float Kernel::sum() const {
  float sum = 0.0F;
  for (const float weight : weights) sum += weight;
  return sum;
}

void Kernel::scale(float factor) {
  for (float& weight : weights) weight *= factor;
}

Plane convolve(const Plane& plane, std::uint32_t width, std::uint32_t height, const Kernel& across, const Kernel& down) {
  const auto w = static_cast<std::ptrdiff_t>(width);
  const auto h = static_cast<std::ptrdiff_t>(height);
  Plane halfway(plane.size());
  parallel_ranges(height, 8, [&](std::size_t first, std::size_t last) {
    // The row with its ends drawn out, so that the inner loop has no cases.
    const std::ptrdiff_t radius = across.radius();
    std::vector<float> row(static_cast<std::size_t>(w + 2 * radius));
    for (std::size_t y = first; y < last; ++y) {
      const float* const source = plane.data() + y * width;
      for (std::ptrdiff_t x = -radius; x < w + radius; ++x) {
        row[static_cast<std::size_t>(x + radius)] = source[std::clamp<std::ptrdiff_t>(x, 0, w - 1)];
      }
      float* const target = halfway.data() + y * width;
      for (std::size_t tap = 0; tap < across.weights.size(); ++tap) {
        const float weight = across.weights[tap];
        for (std::size_t x = 0; x < width; ++x) target[x] += weight * row[x + tap];
      }
    }
  });
  Plane result(plane.size());
  parallel_for(height, 8, [&](std::size_t y) {
    float* const target = result.data() + y * width;
    for (int tap = -down.radius(); tap <= down.radius(); ++tap) {
      const auto from = std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(y) + tap, 0, h - 1);
      const float* const source = halfway.data() + static_cast<std::size_t>(from) * width;
      const float weight = down.at(tap);
      for (std::size_t x = 0; x < width; ++x) target[x] += weight * source[x];
    }
  });
  return result;
}

}  // namespace grove
