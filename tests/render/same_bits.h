#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "grove/render/film.h"

namespace grove::testing {

/// Whether two films hold the same sums and counts, bit for bit.
inline bool same_bits(const Film& a, const Film& b) {
  if (a.width() != b.width() || a.height() != b.height()) return false;
  using Bits = std::array<std::uint32_t, sizeof(Film::Pixel) / sizeof(std::uint32_t)>;
  for (std::uint32_t y = 0; y < a.height(); ++y)
    for (std::uint32_t x = 0; x < a.width(); ++x)
      if (std::bit_cast<Bits>(a.pixel(x, y)) != std::bit_cast<Bits>(b.pixel(x, y))) return false;
  return true;
}

}  // namespace grove::testing
