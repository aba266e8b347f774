#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace grove {

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
