#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "grove/scene/image.h"

namespace grove {

/// Reads PNG, JPEG, TGA, BMP, HDR (by stb_image), PFM and EXR; the format is told from the content. HDR, PFM and EXR give floats.
/// Sizes in headers are checked against the file's length and a limit of 2^28 pixels before memory is asked for.
/// Throws InputError naming the file.
[[nodiscard]] Image read_image(const std::filesystem::path& file);

/// The same from memory; `name` is for messages.
[[nodiscard]] Image decode_image(std::span<const std::byte> data, const std::string& name);

}  // namespace grove
