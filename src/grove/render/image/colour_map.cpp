#include "grove/render/image/colour_map.h"

#include <cmath>

#include "grove/render/image/tone_map.h"

namespace grove {

Vec3 colour_map(float value) {
  const float x = value > 0.0F ? (value < 1.0F ? value : 1.0F) : 0.0F;
  // In Oklab's polar form: lightness straight up, hue from violet (-70 degrees) to yellow (105), chroma full in the middle, where the
  // screen has room for it.
  const float lightness = 0.12F + 0.84F * x;
  const float hue = (-70.0F + 175.0F * x) * (kPi / 180.0F);
  const float chroma = 0.01F + 0.19F * std::sin(kPi * std::pow(x, 0.85F));
  const float a = chroma * std::cos(hue);
  const float b = chroma * std::sin(hue);
  // Oklab to linear sRGB, by the matrices of its definition.
  const float l = std::pow(lightness + 0.3963377774F * a + 0.2158037573F * b, 3.0F);
  const float m = std::pow(lightness - 0.1055613458F * a - 0.0638541728F * b, 3.0F);
  const float s = std::pow(lightness - 0.0894841775F * a - 1.2914855480F * b, 3.0F);
  return {encode_srgb(4.0767416621F * l - 3.3077115913F * m + 0.2309699292F * s),
          encode_srgb(-1.2684380046F * l + 2.6097574011F * m - 0.3413193965F * s),
          encode_srgb(-0.0041960863F * l - 0.7034186147F * m + 1.7076147010F * s)};
}

}  // namespace grove
