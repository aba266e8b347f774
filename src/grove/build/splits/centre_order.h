#pragma once

// The order of references along an axis: by the centres of their boxes, equal ones by primitive id. A split at a place of that order can
// be told from each reference alone, so references may move while they are parted.

#include <bit>
#include <cstdint>

#include "grove/build/split.h"

namespace grove {

/// A whole number that orders as (centre on `axis`, primitive id) does.
[[nodiscard]] inline std::uint64_t centre_key(const PrimitiveReference& reference, int axis) {
  // Adding zero makes -0 a +0. Floats order as their bits do, negative ones the other way round.
  const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(reference.doubled_centre()[axis]) + 0.0F);
  const std::uint32_t ordered = (bits & 0x80000000U) != 0 ? ~bits : bits | 0x80000000U;
  return (std::uint64_t{ordered} << 32) | reference.primitive();
}

/// References before `first_right` in the order along `axis` go left.
struct OrderedSplit : Split {
  int axis = 0;
  std::uint64_t first_right = 0;

  [[nodiscard]] Side side(const PrimitiveReference& reference) const {
    return centre_key(reference, axis) < first_right ? Side::left : Side::right;
  }
};

}  // namespace grove
