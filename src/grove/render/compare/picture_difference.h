#pragma once

#include <filesystem>

#include "grove/render/image/colour_image.h"
#include "grove/render/image/tone_map.h"

namespace grove {

/// How far a picture is from a reference. All are 0 for equal pictures.
struct PictureDifference {
  /// Root of the mean squared difference over pixels and channels, in linear light.
  double rmse = 0.0;
  /// Mean of squared difference over (squared reference + 0.01), over pixels and channels (Rousselle, Knaus, Zwicker 2011, "Adaptive Sampling and Reconstruction using
  /// Greedy Error Minimization"): dark places count as much as bright ones.
  double relative_mse = 0.0;
  /// Mean LDR-FLIP, from 0 to 1, of both pictures as a .png would show them.
  double flip = 0.0;
  /// Mean HDR-FLIP, from 0 to 1.
  double hdr_flip = 0.0;
  /// The mean picture value minus that of the reference, over that of the reference: what noise alone does not change. 0 for a black reference.
  double relative_bias = 0.0;
};

/// Compares; `gain` and `curve` say how a .png shows the pictures. Both must be of one size. In parallel in the caller's arena, with the same result for any number
/// of threads.
[[nodiscard]] PictureDifference compare_pictures(const ColourImage& reference, const ColourImage& test, float gain, ToneMap curve);

/// Reads a picture in linear light (.exr, .hdr or .pfm) to compare with. Throws InputError naming the file, also when it is one of 8 bits, which have lost too much, or
/// when it is not of this size.
[[nodiscard]] ColourImage read_reference(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height);

}  // namespace grove
