#include "grove/render/denoise/noise_estimate.h"

#include <algorithm>

#include "grove/base/parallel.h"
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
  const std::vector<float> luminances = light.luminances();
  parallel_for(guides.height, 4, [&](std::size_t row) {
    const auto y = static_cast<std::ptrdiff_t>(row);
    for (std::ptrdiff_t x = 0; x < width; ++x) {
      const auto p = static_cast<std::size_t>(y * width + x);
      Mean pure;
      Mean known;
      float sum = 0.0F;
      float squares = 0.0F;
      float count = 0.0F;
      for_each_on_surface(guides, x, y, kRadius, [&](std::size_t q) {
        if (measured[q].is_known) (measured[q].is_pure ? pure : known).add(measured[q].variance);
        // From the pixel's own value, so that no digits are lost.
        const float difference = luminances[q] - luminances[p];
        sum += difference;
        squares += difference * difference;
        count += 1.0F;
      });
      if (pure.count > 0.0F || known.count > 0.0F) {
        light.variance[p] = pure.count > 0.0F ? pure.sum / pure.count : known.sum / known.count;
      } else {
        light.variance[p] = std::max(squares / count - (sum / count) * (sum / count), 0.0F);
      }
    }
  });
}

}  // namespace grove
