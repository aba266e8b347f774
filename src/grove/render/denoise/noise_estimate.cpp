#include "grove/render/denoise/noise_estimate.h"

#include <algorithm>

#include "grove/base/parallel.h"
#include "grove/render/bsdf/bsdf_types.h"
#include "grove/render/denoise/same_surface.h"

namespace grove {
namespace {

constexpr std::ptrdiff_t kRadius = 3;

struct Mean {
  float sum = 0.0F;
  float count = 0.0F;

  void add(float value) {
    sum += value;
    count += 1.0F;
  }
};

}  // namespace

void estimate_noise(std::span<const MeasuredNoise> measured, const Guides& guides, Illumination& light) {
  const auto width = static_cast<std::ptrdiff_t>(guides.width);
  const auto height = static_cast<std::ptrdiff_t>(guides.height);
  std::vector<float> luminances(light.red.size());
  parallel_for(luminances.size(), 4096, [&](std::size_t i) { luminances[i] = luminance(light.colour(i)); });
  parallel_for(guides.height, 4, [&](std::size_t row) {
    const auto y = static_cast<std::ptrdiff_t>(row);
    for (std::ptrdiff_t x = 0; x < width; ++x) {
      const auto p = static_cast<std::size_t>(y * width + x);
      Mean pure;
      Mean known;
      float sum = 0.0F;
      float squares = 0.0F;
      float count = 0.0F;
      for (std::ptrdiff_t qy = std::max<std::ptrdiff_t>(0, y - kRadius); qy <= std::min(height - 1, y + kRadius); ++qy) {
        for (std::ptrdiff_t qx = std::max<std::ptrdiff_t>(0, x - kRadius); qx <= std::min(width - 1, x + kRadius); ++qx) {
          const auto q = static_cast<std::size_t>(qy * width + qx);
          if (q != p && !is_same_surface(guides, p, q, static_cast<float>(qx - x), static_cast<float>(qy - y))) continue;
          if (measured[q].is_known) (measured[q].is_pure ? pure : known).add(measured[q].variance);
          // From the pixel's own value, so that no digits are lost.
          const float difference = luminances[q] - luminances[p];
          sum += difference;
          squares += difference * difference;
          count += 1.0F;
        }
      }
      if (pure.count > 0.0F || known.count > 0.0F) {
        light.variance[p] = pure.count > 0.0F ? pure.sum / pure.count : known.sum / known.count;
      } else {
        light.variance[p] = std::max(squares / count - (sum / count) * (sum / count), 0.0F);
      }
    }
  });
}

}  // namespace grove
