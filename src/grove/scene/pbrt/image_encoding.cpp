#include "grove/scene/pbrt/image_encoding.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "grove/scene/pbrt/numbers.h"

namespace grove::pbrt {
namespace {

float srgb_to_linear(float v) {
  return v <= 0.04045F ? v / 12.92F : std::pow((v + 0.055F) / 1.055F, 2.4F);
}

}  // namespace

std::optional<ImageEncoding> parse_image_encoding(std::string_view text) {
  if (text == "sRGB" || text == "srgb") return ImageEncoding{};
  if (text == "linear") return ImageEncoding{.srgb = false};
  constexpr std::string_view kGamma = "gamma ";
  if (!text.starts_with(kGamma)) return std::nullopt;
  const auto gamma = parse_float(text.substr(kGamma.size()));
  if (!gamma || !(*gamma > 0.0F) || !std::isfinite(*gamma)) return std::nullopt;
  return ImageEncoding{.srgb = false, .gamma = *gamma};
}

Image decode_gamma(const Image& image, float gamma) {
  std::array<float, 256> decoded;
  for (std::size_t i = 0; i < decoded.size(); ++i) decoded[i] = std::pow(static_cast<float>(i) / 255.0F, gamma);
  Image result;
  result.name = image.name;
  result.width = image.width;
  result.height = image.height;
  result.channels = image.channels;
  result.floats.resize(image.bytes.size());
  const bool has_alpha = image.channels % 2 == 0;
  for (std::size_t i = 0; i < image.bytes.size(); ++i) {
    const bool is_alpha = has_alpha && i % image.channels == image.channels - 1;
    result.floats[i] = is_alpha ? static_cast<float>(image.bytes[i]) / 255.0F : decoded[image.bytes[i]];
  }
  return result;
}

Image map_first_channel(const Image& image, bool srgb, const std::function<float(float)>& function) {
  Image result;
  result.name = image.name;
  result.width = image.width;
  result.height = image.height;
  result.channels = 1;
  const std::size_t count = std::size_t{image.width} * image.height;
  if (image.is_float()) {
    result.floats.resize(count);
    for (std::size_t i = 0; i < count; ++i) result.floats[i] = function(image.floats[i * image.channels]);
    return result;
  }
  std::array<std::uint8_t, 256> mapped;
  for (std::size_t i = 0; i < mapped.size(); ++i) {
    const float value = static_cast<float>(i) / 255.0F;
    const float out = std::clamp(function(srgb ? srgb_to_linear(value) : value), 0.0F, 1.0F);
    mapped[i] = static_cast<std::uint8_t>(std::lround(255.0F * out));
  }
  result.bytes.resize(count);
  for (std::size_t i = 0; i < count; ++i) result.bytes[i] = mapped[image.bytes[i * image.channels]];
  return result;
}

}  // namespace grove::pbrt
