#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "grove/scene/image.h"

namespace grove {

/// Throws InputError unless the picture has pixels, at most 2^28 of them, and at most `pixels_per_byte` for each byte of its file:
/// what the format's best compression could give, so that a lying header cannot ask for memory that the file has no data for.
void check_image_size(std::uint64_t width, std::uint64_t height, std::size_t file_bytes, std::uint64_t pixels_per_byte,
                      const std::string& name);

/// PNG, JPEG, BMP and TGA as bytes, Radiance HDR as floats, by stb_image. Throws InputError naming `name`.
[[nodiscard]] Image decode_by_stb(std::span<const std::byte> data, const std::string& name);

/// OpenEXR: the channels R, G, B and A, or Y; other channels are not read. Throws InputError naming `name`.
[[nodiscard]] Image decode_exr(std::span<const std::byte> data, const std::string& name);

/// Portable float map: one or three channels, either byte order. Throws InputError naming `name`.
[[nodiscard]] Image decode_pfm(std::span<const std::byte> data, const std::string& name);

}  // namespace grove
