#pragma once

// Morton codes: the bits of three whole coordinates taken in turn, so that numbers near in order are near in space.

#include <cstdint>

namespace grove {

/// Moves the low 21 bits of `v` apart, to every third place.
[[nodiscard]] constexpr std::uint64_t spread_bits(std::uint64_t v) {
  v &= 0x1fffffULL;
  v = (v | v << 32) & 0x001f00000000ffffULL;
  v = (v | v << 16) & 0x001f0000ff0000ffULL;
  v = (v | v << 8) & 0x100f00f00f00f00fULL;
  v = (v | v << 4) & 0x10c30c30c30c30c3ULL;
  v = (v | v << 2) & 0x1249249249249249ULL;
  return v;
}

/// The code of three coordinates of up to 21 bits each; x is the most significant. 63 bits.
[[nodiscard]] constexpr std::uint64_t morton_code(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  return spread_bits(x) << 2 | spread_bits(y) << 1 | spread_bits(z);
}

}  // namespace grove
