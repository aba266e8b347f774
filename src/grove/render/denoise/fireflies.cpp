#include "grove/render/denoise/fireflies.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "grove/base/parallel.h"
#include "grove/render/denoise/same_surface.h"

namespace grove {
namespace {

constexpr std::ptrdiff_t kRadius = 3;
// With fewer neighbours on its surface a pixel is measured by all surfaces nearby: on a thin one it would be by nothing.
constexpr int kFewestNeighbours = 4;
// What a pixel may have of the brightest of its neighbours.
constexpr float kTolerance = 1.5F;
// Standard deviations of its own mean that bear a pixel out.
constexpr float kSignificance = 4.0F;
// Other surfaces bear less witness. A single bright sample is one standard deviation, two are 1.4.
constexpr float kThinSignificance = 2.0F;

}  // namespace

void limit_fireflies(std::span<MeasuredNoise> measured, const Guides& guides, Illumination& light) {
  const auto width = static_cast<std::ptrdiff_t>(guides.width);
  const std::vector<float> luminances = light.luminances();
  parallel_for(guides.height, 4, [&](std::size_t row) {
    const auto y = static_cast<std::ptrdiff_t>(row);
    for (std::ptrdiff_t x = 0; x < width; ++x) {
      const auto p = static_cast<std::size_t>(y * width + x);
      float brightest = 0.0F;
      int count = 0;
      for_each_on_surface(guides, x, y, kRadius, [&](std::size_t q) {
        if (q == p) return;
        brightest = std::max(brightest, luminances[q]);
        ++count;
      });
      float significance = kSignificance;
      if (count < kFewestNeighbours) {
        significance = kThinSignificance;
        for_each_within(guides, x, y, kRadius, [&](std::size_t q) {
          if (q == p || !guides.is_surface(q)) return;
          brightest = std::max(brightest, luminances[q]);
          ++count;
        });
      }
      const float limit = kTolerance * brightest;
      const float excess = luminances[p] - limit;
      MeasuredNoise& noise = measured[p];
      if (count < kFewestNeighbours || !(excess > 0.0F)) continue;
      // A single sample bears nothing out.
      if (noise.is_known && excess > significance * std::sqrt(noise.variance)) continue;
      const float scale = limit / luminances[p];
      light.set_colour(p, scale * light.colour(p));
      noise.variance *= scale * scale;
    }
  });
}

}  // namespace grove
