#include "grove/render/image/tone_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "grove/base/error.h"

namespace grove {
namespace {

constexpr std::array<std::string_view, 3> kNames = {"none", "filmic", "aces"};

// Where Narkowicz's curve gives 0.18: the solution of x (2.51 x + 0.03) = 0.18 (x (2.43 x + 0.59) + 0.14), over 0.18.
constexpr float kAcesScale = 0.7232F;

float aces_curve(float x) {
  return std::clamp(x * (2.51F * x + 0.03F) / (x * (2.43F * x + 0.59F) + 0.14F), 0.0F, 1.0F);
}

// Hable's curve with the six parameters of his talk: shoulder strength A, linear strength B, linear angle C, toe strength D, toe numerator E and
// denominator F, as (x (A x + C B) + D E) / (x (A x + B) + D F) - E / F.
float hable_curve(float x) {
  constexpr float a = 0.15F;
  constexpr float b = 0.5F;
  constexpr float c = 0.1F;
  constexpr float d = 0.2F;
  constexpr float e = 0.02F;
  constexpr float f = 0.3F;
  return (x * (a * x + c * b) + d * e) / (x * (a * x + b) + d * f) - e / f;
}

constexpr float kHableWhite = 11.2F;

float filmic_curve(float x) {
  static const float kOverWhite = 1.0F / hable_curve(kHableWhite);
  return std::clamp(hable_curve(x) * kOverWhite, 0.0F, 1.0F);
}

// Where filmic_curve gives 0.18, over 0.18; the curve has no inverse worth writing down.
float filmic_scale() {
  float low = 0.0F;
  float high = kHableWhite;
  for (int step = 0; step < 40; ++step) {
    const float middle = 0.5F * (low + high);
    (filmic_curve(middle) < 0.18F ? low : high) = middle;
  }
  return low / 0.18F;
}

template <typename Curve>
Vec3 through(const Curve& curve, float scale, const Vec3& colour) {
  // A little of each channel in the others, so that a light too bright for its colour turns white instead of clipping to a primary.
  constexpr float kMixing = 0.06F;
  const float mean = (colour.x + colour.y + colour.z) / 3.0F;
  Vec3 result;
  for (int channel = 0; channel < 3; ++channel) {
    const float mixed = scale * (colour[channel] + kMixing * (mean - colour[channel]));
    // Far above white the squares would overflow.
    result[channel] = mixed > 0.0F ? curve(std::min(mixed, 1e6F)) : 0.0F;
  }
  return result;
}

// Where the two pieces of the curve meet. The standard rounds it to 0.0031308, where they are 3e-8 apart and the curve would step down.
constexpr double kLinearJoint = 0.003130668442500559;
constexpr double kEncodedJoint = 12.92 * kLinearJoint;

// In double, so that the result is the nearest float but for the last bit.
double encode(double linear) {
  return linear <= kLinearJoint ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

}  // namespace

std::span<const std::string_view> tone_map_names() {
  return kNames;
}

ToneMap tone_map_from_name(std::string_view name) {
  const auto* const found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) throw UsageError("unknown tone map '" + std::string(name) + "'; choose one of none, filmic, aces");
  return static_cast<ToneMap>(found - kNames.begin());
}

Vec3 tone_map(ToneMap curve, const Vec3& colour) {
  switch (curve) {
    case ToneMap::none:
      break;
    case ToneMap::filmic: {
      static const float kScale = filmic_scale();
      return through(filmic_curve, kScale, colour);
    }
    case ToneMap::aces:
      return through(aces_curve, kAcesScale, colour);
  }
  Vec3 result;
  for (int channel = 0; channel < 3; ++channel) result[channel] = colour[channel] > 0.0F ? std::min(colour[channel], 1.0F) : 0.0F;
  return result;
}

float encode_srgb(float linear) {
  if (!(linear > 0.0F)) return 0.0F;
  return linear >= 1.0F ? 1.0F : static_cast<float>(encode(linear));
}

float decode_srgb(float encoded) {
  if (!(encoded > 0.0F)) return 0.0F;
  if (encoded >= 1.0F) return 1.0F;
  const double value = encoded;
  return static_cast<float>(value <= kEncodedJoint ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
}

}  // namespace grove
