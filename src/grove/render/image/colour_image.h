#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "grove/render/film.h"

namespace grove {

/// Colours in linear light (Rec. 709 primaries), row 0 at the top.
struct ColourImage {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<Vec3> pixels;  ///< width * height

  ColourImage() = default;
  ColourImage(std::uint32_t columns, std::uint32_t rows) : width(columns), height(rows), pixels(std::size_t{columns} * rows, Vec3(0.0F)) {}

  [[nodiscard]] Vec3& at(std::uint32_t x, std::uint32_t y) { return pixels[std::size_t{y} * width + x]; }
  [[nodiscard]] const Vec3& at(std::uint32_t x, std::uint32_t y) const { return pixels[std::size_t{y} * width + x]; }
};

/// The mean radiance of each pixel; zeros where there are no samples.
[[nodiscard]] inline ColourImage mean_colours(const Film& film) {
  ColourImage image(film.width(), film.height());
  for (std::uint32_t y = 0; y < film.height(); ++y)
    for (std::uint32_t x = 0; x < film.width(); ++x) image.at(x, y) = film.mean(x, y).radiance;
  return image;
}

}  // namespace grove
