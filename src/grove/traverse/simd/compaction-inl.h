// Moving lanes of a register about. Included once for each instruction set.

#if defined(GROVE_COMPACTION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_COMPACTION_INL_H
#undef GROVE_COMPACTION_INL_H
#else
#define GROVE_COMPACTION_INL_H
#endif

#include <hwy/highway.h>

#include <cstdint>
#include <type_traits>

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

// The lanes whose bits are set.
template <typename D>
HWY_INLINE hn::Mask<D> mask_of(D d, std::uint32_t bits) {
  const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8U)};
  return hn::LoadMaskBits(d, bytes);
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

// Bits for all lanes.
struct AllLanes {
  HWY_INLINE std::uint32_t operator&(std::uint32_t bits) const { return bits; }
};

// Some lanes of eight.
template <typename D>
class LaneSet {
 public:
  // Those of a mask whose bits are set, or AllLanes().
  template <typename Bits>
  HWY_INLINE LaneSet(D d, hn::Mask<D> mask, Bits among) : mask_(mask), bits_(among & bits_of(d, mask)) {
#if HWY_TARGET <= HWY_AVX3
    if constexpr (!std::is_same_v<Bits, AllLanes>) mask_ = mask_of(d, bits_);
#endif
  }

  [[nodiscard]] HWY_INLINE std::uint32_t bits() const {
    return bits_;
  }

  // These lanes of `v` in their order; what comes behind them means nothing. By an instruction where there is one, otherwise by a table.
  template <typename DV, typename V>
  [[nodiscard]] HWY_INLINE V to_front(DV d, V v) const {
#if HWY_TARGET <= HWY_AVX3
    static_cast<void>(d);
    return hn::Compress(v, hn::RebindMask(d, mask_));
#else
    const hn::RebindToUnsigned<DV> du;
    const hn::Rebind<std::uint8_t, decltype(du)> d8;
    return look_up(d, v, hn::PromoteTo(du, hn::LoadU(d8, kFrontPlaces[bits_].data())));
#endif
  }

 private:
  hn::Mask<D> mask_;
  std::uint32_t bits_;
};

}  // namespace HWY_NAMESPACE
}  // namespace grove
HWY_AFTER_NAMESPACE();

#endif
