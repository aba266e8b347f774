#pragma once

#include <cstdint>

#include "grove/base/huge_vector.h"

namespace grove {

/// A key and what it belongs to.
struct KeyedIndex {
  std::uint64_t key;
  std::uint32_t index;
};

/// Sorts by bits [first_bit, end_bit) of the words. Otherwise as the next.
void radix_sort(HugeVector<std::uint64_t>& words, int first_bit, int end_bit);

/// Sorts by the low `bits` bits of the keys, which must be all that are set; equal keys keep their order. Least significant digit first, 12 bits at a
/// time; digits in which all keys agree are skipped. Parallel in chunks of fixed size: the same for any number of threads. O(n bits / 12);
/// memory for a second array of the same size.
void radix_sort(HugeVector<KeyedIndex>& items, int bits);

}  // namespace grove
