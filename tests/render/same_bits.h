#pragma once

#include <cstring>

#include "grove/render/film.h"

namespace grove::testing {

/// Whether two films hold the same sums and counts, bit for bit.
inline bool same_bits(const Film& a, const Film& b) {
  if (a.width() != b.width() || a.height() != b.height()) return false;
  static_assert(sizeof(Film::Pixel) == sizeof(Film::Sample) + sizeof(float) + 2 * sizeof(std::uint32_t), "pixels have no padding");
  for (std::uint32_t y = 0; y < a.height(); ++y)
    for (std::uint32_t x = 0; x < a.width(); ++x)
      if (std::memcmp(&a.pixel(x, y), &b.pixel(x, y), sizeof(Film::Pixel)) != 0) return false;
  return true;
}

}  // namespace grove::testing
