#pragma once

#include <string>

#include "grove/render/picture_part.h"

namespace grove::app {

/// Sets the share of tiles from "i/N" with 1 <= i <= N. Throws UsageError.
void parse_tile(const std::string& text, PicturePart& part);

/// Sets the range of samples from "a:b" with a < b <= samples_per_pixel. Throws UsageError.
void parse_samples(const std::string& text, std::uint32_t samples_per_pixel, PicturePart& part);

}  // namespace grove::app
