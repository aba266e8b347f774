#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "grove/geometry/hit.h"
#include "grove/math/vector.h"

namespace grove {

/// What earlier frames found out about a pixel.
struct PixelHistory {
  Vec3 reflected{0.0F};  ///< mean over the frames, as all that follow
  /// The same but never clamped to what a later frame shows: it does not lose what is rare and bright, and is slow to see that lights have changed.
  Vec3 unclamped{0.0F};
  Vec3 albedo{0.0F};
  Vec3 emitted{0.0F};
  /// Of the samples' luminances of reflected over albedo: the unbiased variance of one, which takes two samples to know of.
  float sample_variance = 0.0F;
  /// What `sample_variance` is to be multiplied by for the variance of the mean: one over the number of samples where all count alike.
  float share = 0.0F;
  float sample_count = 0.0F;  ///< that all this is the mean of; 0 where there is nothing to go by
  // The first surface in the last frame.
  Vec3 normal{0.0F};
  float depth = 0.0F;
  std::uint32_t geometry = kInvalidId;
  std::uint32_t instance = kInvalidId;
};

/// One for each pixel, row 0 at the top. Memory: 84 bytes a pixel.
struct FrameHistory {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<PixelHistory> pixels;
};

}  // namespace grove
