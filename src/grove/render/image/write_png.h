#pragma once

#include <filesystem>

#include "grove/render/image/tone_map.h"
#include "grove/render/render.h"

namespace grove {

struct DisplaySettings {
  /// Stops (powers of two) by which a path-traced picture is brightened before tone mapping.
  float exposure = 0.0F;
  ToneMap tone_map = ToneMap::aces;
};

/// Writes a picture for the eye, 8-bit RGB PNG with sRGB encoding. Path-traced light is exposed and tone-mapped; distances run from
/// white (near) to black (far); costs go through the colour map of image/colour_map.h, whose top is the 99th percentile; the rest is
/// written as it is. The file appears whole or not at all. Throws OutputError.
void write_png(const RenderResult& result, const DisplaySettings& settings, const std::filesystem::path& path);

}  // namespace grove
