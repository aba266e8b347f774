// Moving the lanes of a register that a mask has together. Included once for each instruction set.

#if defined(GROVE_COMPACTION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_COMPACTION_INL_H
#undef GROVE_COMPACTION_INL_H
#else
#define GROVE_COMPACTION_INL_H
#endif

#include <hwy/highway.h>

#include <bit>
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
  return bits[0] & ((1U << hn::MaxLanes(D())) - 1);
}

// Moves the lanes of eight that a mask has to the front. By a table on every instruction set: where there is an instruction for it, it is not faster.
template <typename D>
class Compaction {
 public:
  static constexpr bool kIsThere = hn::MaxLanes(D()) == 8;

  HWY_INLINE Compaction(D d, hn::Mask<D> mask) : bits_(bits_of(d, mask)) {
    const hn::Rebind<std::uint8_t, D> d8;
    places_ = hn::PromoteTo(hn::RebindToUnsigned<D>(), hn::LoadU(d8, kFrontPlaces[bits_].data()));
  }

  [[nodiscard]] HWY_INLINE std::uint32_t bits() const { return bits_; }
  [[nodiscard]] HWY_INLINE std::uint32_t count() const { return static_cast<std::uint32_t>(std::popcount(bits_)); }

  template <typename DV, typename V>
  HWY_INLINE V operator()(DV d, V v) const {
    return hn::TableLookupLanes(v, hn::IndicesFromVec(d, places_));
  }

 private:
  std::uint32_t bits_;
  hn::Vec<hn::RebindToUnsigned<D>> places_;
};

}  // namespace HWY_NAMESPACE
}  // namespace grove
HWY_AFTER_NAMESPACE();

#endif
