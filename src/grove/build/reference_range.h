#pragma once

#include <cstdint>

#include "grove/build/primitive_reference.h"

namespace grove {

/// References [first, first + count) of a buffer, and what splits need to know of them. A builder that divides references may use the
/// buffer as far as first + capacity; without dividing capacity equals count.
struct ReferenceRange {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  std::uint32_t capacity = 0;
  Box4 bounds = Box4::empty();
  Box4 centres = Box4::empty();  ///< of the doubled centres

  [[nodiscard]] std::uint32_t slack() const { return capacity - count; }
};

/// Measures `count` references from `first` on.
[[nodiscard]] inline ReferenceRange measure(const PrimitiveReference* references, std::uint32_t first, std::uint32_t count) {
  ReferenceRange range{first, count, count};
  for (std::uint32_t i = first; i < first + count; ++i) {
    const Box4 box = references[i].box();
    range.bounds.grow(box);
    range.centres.grow(box.lower + box.upper);
  }
  return range;
}

/// The same in parallel, for a whole buffer.
[[nodiscard]] ReferenceRange measure_all(const HugeVector<PrimitiveReference>& references);

}  // namespace grove
