#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "grove/geometry/hit.h"

namespace grove {

/// Turns a hit's number within a whole set into (part, number within the part); `part_first` holds the first number of each part,
/// ascending. A miss stays as it is. O(log parts).
inline void locate_in_parts(std::span<const std::uint32_t> part_first, Hit& hit) {
  if (!hit) return;
  const auto next = std::upper_bound(part_first.begin(), part_first.end(), hit.primitive);
  hit.geometry = static_cast<std::uint32_t>(next - part_first.begin()) - 1;
  hit.primitive -= part_first[hit.geometry];
}

}  // namespace grove
