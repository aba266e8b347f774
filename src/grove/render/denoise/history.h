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
  Vec3 albedo{0.0F};
  Vec3 emitted{0.0F};
  float variance = 0.0F;      ///< of the luminance of reflected over albedo, as noise
  float sample_count = 0.0F;  ///< that all this is the mean of; 0 where there is nothing to go by
  // The first surface in the last frame.
  Vec3 normal{0.0F};
  float depth = 0.0F;
  std::uint32_t geometry = kInvalidId;
  std::uint32_t instance = kInvalidId;
};

/// One for each pixel, row 0 at the top. Memory: 68 bytes a pixel.
struct FrameHistory {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<PixelHistory> pixels;
};

}  // namespace grove
