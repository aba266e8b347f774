#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace grove {

/// The highest bit of a number, 0 for 0. A table is faster than the instruction for it on some processors.
inline constexpr auto kHighestBit = [] {
  std::array<std::uint8_t, 256> table{};
  for (unsigned i = 1; i < 256; ++i) table[i] = static_cast<std::uint8_t>(std::bit_width(i) - 1);
  return table;
}();

/// The places of the bits of a number, before the others. (Highway has such a table too, but as a local one it may be copied at each use.)
inline constexpr auto kFrontPlaces = [] {
  std::array<std::array<std::uint8_t, 8>, 256> table{};
  for (unsigned bits = 0; bits < 256; ++bits) {
    std::size_t next = 0;
    for (int side = 1; side >= 0; --side)
      for (unsigned place = 0; place < 8; ++place)
        if ((bits >> place & 1U) == static_cast<unsigned>(side)) table[bits][next++] = static_cast<std::uint8_t>(place);
  }
  return table;
}();

}  // namespace grove
