#pragma once

#include <cstddef>
#include <vector>

#include "grove/math/vector.h"

namespace grove {

/// Light before it meets the albedo of the first surface, with how sure it is: an array for each, row by row. Memory: 16 bytes a pixel.
struct Illumination {
  std::vector<float> red, green, blue;
  /// Estimated variance of the luminance, as noise.
  std::vector<float> variance;

  explicit Illumination(std::size_t count = 0) : red(count), green(count), blue(count), variance(count) {}

  [[nodiscard]] Vec3 colour(std::size_t pixel) const { return {red[pixel], green[pixel], blue[pixel]}; }
  void set_colour(std::size_t pixel, const Vec3& colour) {
    red[pixel] = colour.x;
    green[pixel] = colour.y;
    blue[pixel] = colour.z;
  }
  /// Of all pixels. O(pixels); in parallel in the caller's arena.
  [[nodiscard]] std::vector<float> luminances() const;
};

}  // namespace grove
