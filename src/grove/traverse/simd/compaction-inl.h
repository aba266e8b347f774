// Moving lanes of a register about. Included once for each instruction set.

#if defined(GROVE_COMPACTION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_COMPACTION_INL_H
#undef GROVE_COMPACTION_INL_H
#else
#define GROVE_COMPACTION_INL_H
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "grove/traverse/simd/bit_tables.h"

HWY_BEFORE_NAMESPACE();
namespace grove {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <typename D, typename M>
HWY_INLINE std::uint32_t bits_of(D d, M mask) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(d, mask, bits);
  static_assert(hn::MaxLanes(D()) <= 16);
  const std::uint32_t first = bits[0];
  return (first | std::uint32_t{bits[1]} << 8) & ((1U << hn::MaxLanes(D())) - 1);
}

// The lanes of eight whose bits are set, then the others. By a table on every instruction set: where there is an instruction for it, it is not faster.
template <typename DU>
HWY_INLINE hn::Vec<DU> front_places(DU du, std::uint32_t bits) {
  const hn::Rebind<std::uint8_t, DU> d8;
  return hn::PromoteTo(du, hn::LoadU(d8, kFrontPlaces[bits].data()));
}

// Lane i of the result is the lane of `v` that the low three bits of places[i] name. (The instruction looks at no others; checks of debug builds do.)
template <typename D, typename V, typename P>
HWY_INLINE V look_up(D d, V v, P places) {
  static_assert(hn::MaxLanes(D()) == 8);
#if HWY_IS_DEBUG_BUILD
  places = hn::And(places, hn::Set(hn::RebindToUnsigned<D>(), 7));
#endif
  return hn::TableLookupLanes(v, hn::IndicesFromVec(d, places));
}

}  // namespace HWY_NAMESPACE
}  // namespace grove
HWY_AFTER_NAMESPACE();

#endif
