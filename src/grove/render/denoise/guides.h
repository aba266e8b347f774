#pragma once

#include <cstdint>
#include <vector>

#include "grove/render/film.h"
#include "grove/render/layers/first_hits.h"

namespace grove {

/// What a filter may tell surfaces apart by, noise-free: one number per pixel and array, row by row. Memory: 36 bytes a pixel.
struct Guides {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  /// Mean shading normal, of unit length; zeros where nothing was hit.
  std::vector<float> normal_x, normal_y, normal_z;
  std::vector<float> depth;
  /// How depth changes from one pixel to the next within the surface, to the right and down.
  std::vector<float> slope_x, slope_y;
  /// What light is divided by before it is filtered, so that textures are not filtered with it.
  std::vector<Vec3> albedo;

  /// From the means of a film and its first hits. O(pixels); in parallel in the caller's arena.
  [[nodiscard]] static Guides of(const Film& film, const FirstHits& hits);

  [[nodiscard]] bool is_surface(std::size_t pixel) const {
    return normal_x[pixel] != 0.0F || normal_y[pixel] != 0.0F || normal_z[pixel] != 0.0F;
  }
};

/// An albedo that light may be divided by: where a surface reflects nothing its light is its own, and the quotient stays finite.
[[nodiscard]] inline Vec3 divisor(const Vec3& albedo) {
  constexpr float kLeast = 0.01F;
  return glm::max(albedo, Vec3(kLeast));
}

}  // namespace grove
