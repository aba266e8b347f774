#pragma once

#include <filesystem>

#include "grove/render/layers/layer_set.h"
#include "grove/render/render.h"

namespace grove {

/// Writes a picture as a linear OpenEXR file, ZIP-compressed: the colours as R, G, B and each layer of `layers` that the result holds. All are
/// 32-bit floats but for the ids, which are unsigned integers. The file appears whole or not at all. Throws OutputError.
///
/// | layer | channels | |
/// | --- | --- | --- |
/// | albedo | albedo.R, .G, .B | |
/// | normal | normal.X, .Y, .Z | world space |
/// | depth | depth.Z | world units along the viewing axis; 1e10 where there is nothing |
/// | motion | motion.U, .V | pixels since the frame before, U to the right, V upwards |
/// | variance | variance.Y | of the pixel's mean luminance |
/// | samples | samples.Y | |
/// | id | id.primitive, .geometry, .instance | 0xffffffff where there is nothing, or no instance |
/// | noisy | noisy.R, .G, .B | the film's means, where R, G, B are denoised |
void write_exr(const RenderResult& result, LayerSet layers, const std::filesystem::path& path);

}  // namespace grove
