#pragma once

#include <filesystem>

#include "grove/render/film.h"

namespace grove {

/// Writes the means of `film` as a linear OpenEXR file of 32-bit floats, ZIP-compressed: channels R, G, B, and the layers
/// albedo.R, albedo.G, albedo.B and normal.X, normal.Y, normal.Z, the names that denoisers look for. The file appears whole or not at
/// all. Throws OutputError.
void write_exr(const Film& film, const std::filesystem::path& path);

}  // namespace grove
