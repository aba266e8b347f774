// Tests of the triangles that rays in flight have come to. Included once for each instruction set.

#if defined(GROVE_LEAF_TESTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_LEAF_TESTS_INL_H
#undef GROVE_LEAF_TESTS_INL_H
#else
#define GROVE_LEAF_TESTS_INL_H
#endif

#include <hwy/highway.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "grove/traverse/fast_traversal.h"
#include "grove/traverse/simd/batch_slot.h"
#include "grove/traverse/simd/beside.h"
#include "grove/traverse/simd/block_hits-inl.h"
#include "grove/traverse/simd/block_test-inl.h"
#include "grove/traverse/simd/node_step-inl.h"
#include "grove/traverse/simd/triangle_test.h"

HWY_BEFORE_NAMESPACE();
namespace grove {
namespace HWY_NAMESPACE {

// kAny: any hit instead of the closest.
template <typename Bvh, TriangleTest kTest, bool kAny, Beside kBeside>
class LeafTests {
  using Block = typename Bvh::Block;
  static constexpr bool kCounts = kBeside == Beside::counting;
  static constexpr bool kFilters = kBeside == Beside::filtering;
  // Any hit will do, wherever it is.
  static constexpr bool kAnywhere = kAny && !kFilters;
  static constexpr bool kGathers = !std::is_same_v<Block, TriangleBlock>;

 public:
  LeafTests(const BatchQuery<Bvh>& query, BatchMemory& memory)
      : query_(query), memory_(memory), capacity_(memory.capacity()), units_(query.scene.bvh.units()) {}

  // Tests the blocks that slots are at, shortens their stacks where they are hit, and those of slots that look for nothing more to nothing.
  HWY_INLINE void test(SlotSet testing) {
    gather(testing);
    if constexpr (kTest == TriangleTest::watertight) {
      test_watertight(testing);
    } else {
      test_fast(testing);
    }
  }

 private:
  [[nodiscard]] HWY_INLINE const Block& block_at(const BatchSlot& slot) const { return place_of<Block>(units_, slot.next); }

  // Brings the triangles of leaves together where blocks only number their corners: asks for all corners first, so that they come side by side.
  HWY_INLINE void gather(SlotSet slots) {
    if constexpr (kGathers) {
      const Vec3* const vertices = query_.scene.vertices;
      for (SlotSet left = slots; left != 0;) {
        const auto& block = block_at(memory_.slot(take_first(left)));
        for (const auto& corner : block.vertex)
          for (const std::uint32_t vertex : corner) __builtin_prefetch(vertices + vertex);
      }
      for (SlotSet left = slots; left != 0;) {
        const std::uint32_t number = take_first(left);
        gathered_[number] = gathered(block_at(memory_.slot(number)), vertices);
      }
    }
  }

  // What a slot at a leaf is to test.
  [[nodiscard]] HWY_INLINE const TriangleBlock& block_of(std::uint32_t number, const BatchSlot& slot) const {
    if constexpr (kGathers) {
      return gathered_[number];
    } else {
      return block_at(slot);
    }
  }

  HWY_INLINE void count_leaf_of(const BatchSlot& slot, const TriangleBlock& block) {
    if constexpr (kCounts) {
      query_.counts[slot.index].primitives_tested += block.count();
      ++query_.counts[slot.index].leaves_entered;
    }
  }

  // Tests the leaves of slots: first which triangles may be hit at all, for all of them without a branch; then those that may.
  HWY_INLINE void test_watertight(SlotSet testing) {
    std::uint8_t possible[kSlots];
    SlotSet settling = 0;
    for (SlotSet left = testing; left != 0;) {
      const std::uint32_t number = take_first(left);
      BatchSlot& slot = memory_.slot(number);
      const TriangleBlock& block = block_of(number, slot);
      count_leaf_of(slot, block);
      const BlockFilter filter = filter_block<kAnywhere>(slot.ray, slot.t, block);
      bool is_open = filter.possible != 0;
      if constexpr (kAnywhere) {
        // Whatever the distance is exactly, it is in range.
        slot.primitive = filter.certain != 0 ? 0 : slot.primitive;
        slot.stack_size = filter.certain != 0 ? 1 : slot.stack_size;
        is_open = is_open && filter.certain == 0;
      }
      possible[number] = static_cast<std::uint8_t>(filter.possible);
      settling |= SlotSet{is_open ? 1U : 0U} << number;
    }
    settle(settling, possible);
  }

  HWY_INLINE void test_fast(SlotSet testing) {
    SlotSet hit = 0;
    for (SlotSet left = testing; left != 0;) {
      const std::uint32_t number = take_first(left);
      BatchSlot& slot = memory_.slot(number);
      const TriangleBlock& block = block_of(number, slot);
      count_leaf_of(slot, block);
      FourHits hits;
      test_block(slot.ray, slot.t, block, hits);
      if constexpr (kAnywhere) {
        slot.primitive = hits.places != 0 ? 0 : slot.primitive;
        slot.stack_size = hits.places != 0 ? 1 : slot.stack_size;
      } else if (hits.places != 0) {
        Hit closest = slot.hit();
        if constexpr (kFilters) {
          take_closest(hits, block, closest, FilterOfOneRay(*query_.filter, slot.index));
        } else {
          take_closest(hits, block, closest, AcceptsAll());
        }
        slot.take(closest);
        hit |= SlotSet{1} << number;
      }
    }
    while (hit != 0) shorten_stack(memory_.slot(take_first(hit)));
  }

  // Tests the possible triangles of slots, and shortens the stacks of those that are hit.
  HWY_INLINE void settle(SlotSet settling, const std::uint8_t* possible) {
    SlotSet hit = 0;
    while (settling != 0) {
      const std::uint32_t number = take_first(settling);
      const BatchSlot& slot = memory_.slot(number);
      for (std::uint32_t left = possible[number]; left != 0; left &= left - 1) {
        candidates_.append(number, slot.ray, block_of(number, slot), static_cast<std::uint32_t>(std::countr_zero(left)));
        if (candidates_.is_full()) hit |= test_appended();
      }
    }
    hit |= test_appended();
    while (hit != 0) shorten_stack(memory_.slot(take_first(hit)));
  }

  // After a hit.
  HWY_INLINE void shorten_stack(BatchSlot& slot) {
    if constexpr (kAny) {
      if (kAnywhere || slot.primitive != kInvalidId) slot.stack_size = 1;
    } else {
      drop_what_is_farther(slot, capacity_);
    }
  }

  // Returns whose hits are new.
  HWY_INLINE SlotSet test_appended() {
    test_candidates(candidates_);
    SlotSet hit = 0;
    for (std::uint64_t left = candidates_.valid; left != 0; left &= left - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(left));
      const std::uint32_t number = candidates_.slot[i];
      hit |= SlotSet{take_hit(memory_.slot(number), i) ? 1U : 0U} << number;
    }
    for (std::uint64_t left = candidates_.unknown; left != 0; left &= left - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(left));
      const std::uint32_t number = candidates_.slot[i];
      BatchSlot& slot = memory_.slot(number);
      if (test_alone(slot, block_of(number, slot), candidates_.place[i])) hit |= SlotSet{1} << number;
    }
    candidates_.count = 0;
    return hit;
  }

  HWY_INLINE bool take_hit(BatchSlot& slot, std::size_t i) {
    const float* const found = candidates_.hit[i];
    if constexpr (kAnywhere) {
      if (!(found[0] <= slot.t)) return false;
      slot.primitive = 0;
      return true;
    }
    const std::uint32_t primitive = candidates_.primitive[i];
    // Without branches: as many are closer as not.
    const bool is_closer = (static_cast<unsigned>(found[0] < slot.t) |
                            (static_cast<unsigned>(found[0] == slot.t) & static_cast<unsigned>(primitive < slot.primitive))) != 0;
    if constexpr (kFilters) {
      if (!is_closer) return false;
      Hit hit;
      hit.t = found[0];
      hit.primitive = primitive;
      hit.u = found[2];
      hit.v = found[3];
      if (!counts(hit, slot)) return false;
      slot.take(hit);
      return true;
    }
    const hn::CappedTag<std::uint32_t, 4> d;
    auto* const kept = reinterpret_cast<std::uint32_t*>(&slot.t);
    const auto* const closer = reinterpret_cast<const std::uint32_t*>(found);
    const auto mask = hn::Ne(hn::Set(d, is_closer ? 1U : 0U), hn::Zero(d));
    for (std::size_t lane = 0; lane < 4; lane += hn::MaxLanes(d))
      hn::Store(hn::IfThenElse(mask, hn::Load(d, closer + lane), hn::Load(d, kept + lane)), d, kept + lane);
    return is_closer;
  }

  HWY_NOINLINE bool test_alone(BatchSlot& slot, const TriangleBlock& block, std::uint32_t place) {
    const WatertightRay ray = slot.ray.triangle_ray();
    const SingleTriangle triangle = triangle_in(block, place);
    if constexpr (kAnywhere) {
      if (!occluded_watertight(ray, triangle.corners)) return false;
      slot.primitive = 0;
      return true;
    }
    Hit hit = slot.hit();
    if (!intersect_watertight(ray, triangle.corners, &block.primitive[place], hit) || !counts(hit, slot)) return false;
    slot.take(hit);
    return true;
  }

  // Whether a hit of a slot's ray counts that would be its closest.
  [[nodiscard]] HWY_INLINE bool counts(const Hit& hit, const BatchSlot& slot) const {
    if constexpr (kFilters) {
      return (*query_.filter)(slot.index, hit);
    } else {
      return true;
    }
  }

  const BatchQuery<Bvh>& query_;
  BatchMemory& memory_;
  const std::size_t capacity_;
  const FastUnit* const units_;
  HitCandidates candidates_;
  TriangleBlock gathered_[kGathers ? kSlots : 1];  // by slot
};

}  // namespace HWY_NAMESPACE
}  // namespace grove
HWY_AFTER_NAMESPACE();

#endif
