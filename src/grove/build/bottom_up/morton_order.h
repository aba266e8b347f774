#pragma once

#include <cstdint>
#include <vector>

#include "grove/build/bottom_up/radix_sort.h"
#include "grove/build/primitive_reference.h"

namespace grove {

/// An order of references by the Morton codes of their centres, ties in the order of their ids.
struct MortonOrder {
  HugeVector<std::uint64_t> codes;
  HugeVector<std::uint32_t> indices;  ///< into the list that was sorted
};

/// Orders references along the Morton curve over a cube around all centres. Codes have 36 bits; where more than
/// one in 16 references then shares its code with four others, all 63 where codes are shared. O(n), parallel, deterministic.
[[nodiscard]] MortonOrder sort_by_morton_code(const ReferenceList& list);

/// The references of `list` in that order. O(n), parallel.
[[nodiscard]] HugeVector<PrimitiveReference> gather(const ReferenceList& list, const MortonOrder& order);

}  // namespace grove
