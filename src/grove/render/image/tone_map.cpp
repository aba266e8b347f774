#include "grove/render/image/tone_map.h"

#include <algorithm>
#include <cmath>

namespace grove {
namespace {

// Where the fitted curve gives 0.18: the solution of x (2.51 x + 0.03) = 0.18 (x (2.43 x + 0.59) + 0.14), over 0.18.
constexpr float kMiddleGreyScale = 0.7232F;

float curve(float x) {
  return std::clamp(x * (2.51F * x + 0.03F) / (x * (2.43F * x + 0.59F) + 0.14F), 0.0F, 1.0F);
}

}  // namespace

Vec3 tone_map_filmic(const Vec3& colour) {
  // A little of each channel in the others, so that a light too bright for its colour turns white instead of clipping to a primary.
  constexpr float kMixing = 0.06F;
  const float mean = (colour.x + colour.y + colour.z) / 3.0F;
  Vec3 result;
  for (int channel = 0; channel < 3; ++channel) {
    const float mixed = colour[channel] + kMixing * (mean - colour[channel]);
    // Far above white the squares would overflow.
    result[channel] = curve(std::min(kMiddleGreyScale * mixed, 1e6F));
  }
  return result;
}

float encode_srgb(float linear) {
  if (!(linear > 0.0F)) return 0.0F;
  if (linear >= 1.0F) return 1.0F;
  return linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F;
}

}  // namespace grove
