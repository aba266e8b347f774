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
#include "grove/traverse/simd/packet_rays-inl.h"
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

  // The same for slots that are at one block, and whose rays are some of a packet: ray i is in slot slot_of[i].
  HWY_INLINE void test_side_by_side(SlotSet testing, const PacketRays& packet, PacketRays::Set rays, const std::uint8_t* slot_of) {
    if (kTest != TriangleTest::watertight || !packet.has_one_kind_of_axes || std::popcount(rays) < kFewestSideBySide) {
      test(testing);
      return;
    }
    const TriangleBlock& block = gathered(block_at(memory_.slot(slot_of[std::countr_zero(rays)])), query_.scene.vertices);
    std::uint8_t possible[kSlots] = {};
    SlotSet settling = 0;
    const std::uint32_t count = block.count();
    for (std::uint32_t place = 0; place < count; ++place) {
      const PacketRays::Pairs pairs = packet.filter<kAnywhere>(block, place, rays);
      if constexpr (kAnywhere) {
        for (PacketRays::Set left = pairs.certain; left != 0; left &= left - 1) {
          const std::uint32_t number = slot_of[std::countr_zero(left)];
          memory_.slot(number).primitive = 0;
          memory_.slot(number).stack_size = 1;
          settling &= ~(SlotSet{1} << number);
        }
        rays &= ~pairs.certain;
      }
      for (PacketRays::Set left = pairs.possible & rays; left != 0; left &= left - 1) {
        const std::uint32_t number = slot_of[std::countr_zero(left)];
        possible[number] = static_cast<std::uint8_t>(possible[number] | 1U << place);
        settling |= SlotSet{1} << number;
      }
    }
    if constexpr (kGathers)
      for (SlotSet left = settling; left != 0;) gathered_[take_first(left)] = block;
    settle(settling, possible);
  }

 private:
  // With fewer rays it is quicker to test a block's triangles for each.
  static constexpr int kFewestSideBySide = 12;

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
    for (std::size_t i = 0; i < candidates_.count; ++i) {
      const std::uint32_t number = candidates_.slot[i];
      BatchSlot& slot = memory_.slot(number);
      const TriangleBlock& block = block_of(number, slot);
      const bool is_hit = (candidates_.known >> i & 1U) != 0 ? take_hit(slot, block, i) : test_alone(slot, block, candidates_.place[i]);
      hit |= SlotSet{is_hit ? 1U : 0U} << number;
    }
    candidates_.count = 0;
    return hit;
  }

  HWY_INLINE bool take_hit(BatchSlot& slot, const TriangleBlock& block, std::size_t i) {
    const float t = candidates_.t[i];
    if constexpr (kAnywhere) {
      if (!(t >= slot.ray.t_min && t <= slot.t && t < std::numeric_limits<float>::infinity())) return false;
      slot.primitive = 0;
      return true;
    }
    const std::uint32_t primitive = block.primitive[candidates_.place[i]];
    if (!(t >= slot.ray.t_min && is_closer(t, primitive, slot.hit()))) return false;
    const float sum = candidates_.weight[0][i] + candidates_.weight[1][i] + candidates_.weight[2][i];
    Hit hit;
    hit.t = t;
    hit.u = candidates_.weight[1][i] / sum;
    hit.v = candidates_.weight[2][i] / sum;
    hit.primitive = primitive;
    if (!counts(hit, slot)) return false;
    slot.take(hit);
    return true;
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
