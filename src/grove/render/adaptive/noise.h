#pragma once

#include <cstdint>
#include <span>

#include "grove/render/film.h"
#include "grove/render/picture_part.h"

namespace grove {

/// When a pixel has samples enough.
struct NoiseTarget {
  /// A pixel is done at an estimated noise (see `estimate_noise`) of at most this; 0 is off: every pixel gets all samples.
  float target = 0.0F;
  /// No pixel is done with fewer, for an estimate from few samples is itself noise. At least 2.
  std::uint32_t min_samples = 16;
  /// The luminance below which noise counts as if the pixel were this bright. Above 0.
  float floor = 0.01F;

  [[nodiscard]] bool is_on() const { return target > 0.0F; }
  friend bool operator==(const NoiseTarget&, const NoiseTarget&) = default;
};

/// The noise of each pixel of a tile, row by row: the standard error of the mean luminance, over that luminance or `floor`, whichever is larger. It is the
/// larger of two estimates: from the pixel's own samples; and from the samples of the pixels at most two away within the tile, variances and means pooled with
/// the numbers of samples as weights, over the number of samples of this pixel. The second keeps a pixel that happens to have met no rare bright sample
/// from looking calm beside others that did. Samples count as independent of each other; they are spread more evenly than that, so the true noise is
/// lower. Infinite for pixels of fewer than two samples. `noise` must have tile.pixel_count() elements.
///
/// Depends on nothing outside of the tile, so that a part of a picture comes to the same decisions as the whole.
void estimate_noise(const Film& film, const Tile& tile, float floor, std::span<float> noise);

/// What a film, or the part of it, came to.
struct NoiseSummary {
  std::uint32_t least_samples = 0;  ///< of a pixel, dropped ones included
  std::uint32_t most_samples = 0;
  double mean_samples = 0.0;
  double root_mean_square = 0.0;  ///< of the noise of all pixels with two samples or more; NaN where there are none
  double share_within = 0.0;      ///< of all pixels, those with noise of at most the target
};

/// Parallel in the caller's oneTBB arena; the same for any number of threads.
[[nodiscard]] NoiseSummary summarize_noise(const Film& film, const PicturePart& part, const NoiseTarget& target);

}  // namespace grove
