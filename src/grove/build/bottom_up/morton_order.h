#pragma once

#include <cstdint>
#include <vector>

#include "grove/build/bottom_up/radix_sort.h"
#include "grove/build/primitive_reference.h"

namespace grove {

/// References in the order of the Morton codes of their centres, ties in the order of their ids.
struct MortonOrder {
  HugeVector<PrimitiveReference> references;
  HugeVector<std::uint64_t> codes;
};

/// Sorts references along the Morton curve over a cube around all centres. Codes have 36 bits; where more than
/// one in 16 references then shares its code with four others, the full 63. O(n), parallel, deterministic.
[[nodiscard]] MortonOrder sort_by_morton_code(const ReferenceList& list);

}  // namespace grove
