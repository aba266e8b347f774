#include <algorithm>
#include <cmath>

#include "grove/base/parallel.h"
#include "grove/render/bsdf/bsdf_types.h"
#include "grove/render/compare/flip.h"

namespace grove {
namespace {

// The paper's tone map: Narkowicz's fit to the ACES transform of light times 0.6, as (x (a x + b)) / (x (c x + d) + e).
constexpr float kA = 0.6F * 0.6F * 2.51F;
constexpr float kB = 0.6F * 0.03F;
constexpr float kC = 0.6F * 0.6F * 2.43F;
constexpr float kD = 0.6F * 0.59F;
constexpr float kE = 0.14F;

float shown(float x) {
  // Far above white the squares would overflow.
  const float y = x > 0.0F ? std::min(x, 1e6F) : 0.0F;
  return std::min(y * (kA * y + kB) / (y * (kC * y + kD) + kE), 1.0F);
}

// The light that comes to `target` through it: the positive root of (a - t c) x^2 + (b - t d) x - t e.
float light_shown_as(float target) {
  const float a = kA - target * kC;
  const float half_b = 0.5F * (kB - target * kD);
  return (-half_b + std::sqrt(half_b * half_b + a * target * kE)) / a;
}

ColourImage exposed(const ColourImage& image, float stops) {
  ColourImage result(image.width, image.height);
  const float gain = std::exp2(stops);
  parallel_for(image.pixels.size(), 4096, [&](std::size_t i) {
    const Vec3 light = gain * image.pixels[i];
    result.pixels[i] = {shown(light.x), shown(light.y), shown(light.z)};
  });
  return result;
}

}  // namespace

HdrFlip hdr_flip(const ColourImage& reference, const ColourImage& test, float pixels_per_degree) {
  constexpr float kTarget = 0.85F;
  constexpr float kDarkest = 1e-5F;
  constexpr int kMostExposures = 64;
  std::vector<float> light(reference.pixels.size());
  for (std::size_t i = 0; i < light.size(); ++i) {
    const float value = luminance(reference.pixels[i]);
    light[i] = std::isfinite(value) ? value : 0.0F;
  }
  const auto middle = light.begin() + static_cast<std::ptrdiff_t>(light.size() / 2);
  std::nth_element(light.begin(), middle, light.end());
  const float median = std::max(*middle, kDarkest);
  const float brightest = std::max(*std::max_element(middle, light.end()), median);

  HdrFlip result;
  result.first_exposure = std::log2(light_shown_as(kTarget) / brightest);
  result.last_exposure = std::log2(light_shown_as(kTarget) / median);
  const float range = result.last_exposure - result.first_exposure;
  result.exposures = std::clamp(static_cast<int>(std::ceil(range)), 2, kMostExposures);
  result.difference.assign(reference.pixels.size(), 0.0F);
  for (int i = 0; i < result.exposures; ++i) {
    const float stops = result.first_exposure + range * static_cast<float>(i) / static_cast<float>(result.exposures - 1);
    const Plane difference = flip(exposed(reference, stops), exposed(test, stops), pixels_per_degree);
    for (std::size_t p = 0; p < difference.size(); ++p) result.difference[p] = std::max(result.difference[p], difference[p]);
  }
  return result;
}

}  // namespace grove
