#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "grove/scene/image.h"

namespace grove::pbrt {

/// How the 8-bit values of an image stand for numbers: the sRGB curve, or a power; gamma 1 without sRGB is linear.
struct ImageEncoding {
  bool srgb = true;
  float gamma = 1.0F;
};

/// "sRGB", "linear" or "gamma 2.2"; nothing for anything else.
[[nodiscard]] std::optional<ImageEncoding> parse_image_encoding(std::string_view text);

/// The 8-bit image as linear floats; alpha stays as it is.
[[nodiscard]] Image decode_gamma(const Image& image, float gamma);

/// A grey image of `function` over the decoded first channel, 8 bits linear where `image` has 8 bits.
[[nodiscard]] Image map_first_channel(const Image& image, bool srgb, const std::function<float(float)>& function);

}  // namespace grove::pbrt
