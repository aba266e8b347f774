// The kernel of fast_batch.h. Included once for each instruction set.

#if defined(GROVE_BATCH_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_BATCH_KERNEL_INL_H
#undef GROVE_BATCH_KERNEL_INL_H
#else
#define GROVE_BATCH_KERNEL_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <type_traits>
#include <utility>

#include "grove/traverse/fast_traversal.h"
#include "grove/traverse/simd/batch_slot.h"
#include "grove/traverse/simd/beside.h"
#include "grove/traverse/simd/block_hits-inl.h"
#include "grove/traverse/simd/block_test-inl.h"
#include "grove/traverse/simd/node_step-inl.h"
#include "grove/traverse/simd/packet_walk-inl.h"
#include "grove/traverse/simd/ray_group-inl.h"
#include "grove/traverse/simd/triangle_test.h"

HWY_BEFORE_NAMESPACE();
namespace grove {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// kAny: any hit instead of the closest.
template <typename Bvh, TriangleTest kTest, bool kAny, Beside kBeside>
class BatchKernel {
  using Node = typename Bvh::Node;
  using Block = typename Bvh::Block;
  static constexpr bool kCounts = kBeside == Beside::counting;
  static constexpr bool kFilters = kBeside == Beside::filtering;
  // Any hit will do, wherever it is.
  static constexpr bool kAnywhere = kAny && !kFilters;

 public:
  BatchKernel(const BatchQuery<Bvh>& query, BatchMemory& memory)
      : query_(query),
        group_(query.scene.bvh.bounds),
        packet_(query.scene.bvh),
        memory_(memory),
        capacity_(memory.capacity()),
        units_(query.scene.bvh.units()),
        free_(memory.slot_count() == kSlots ? ~SlotSet{0} : (SlotSet{1} << memory.slot_count()) - 1) {}

  void run() {
    fill();
    // Slots at a node are stepped until most have come to a leaf; then all leaves are tested, one after another. So the code of each
    // stays in flight, and branches go the same way.
    finish();
    while ((at_node_ | at_leaf_) != 0) {
      const int few = std::popcount(at_node_ | at_leaf_) / 3;
      while (std::popcount(at_node_) > few || (at_node_ != 0 && at_leaf_ == 0)) {
        step_all();
        finish();
      }
      test_leaves();
      finish();
    }
  }

 private:
  // Sets of slots, a bit for each. A list in memory would be written at places that depend on where rays go, and all loads behind would wait.
  using SlotSet = std::uint64_t;
  static_assert(kSlots <= 64);

  static std::uint32_t take_first(SlotSet& set) {
    const auto first = static_cast<std::uint32_t>(std::countr_zero(set));
    set &= set - 1;
    return first;
  }

  // Takes what is on top of the stacks of slots, fetches it, and puts the slots into the sets for that. Without a branch, which could not be foreseen.
  HWY_INLINE void advance(SlotSet slots) {
    SlotSet leave_nodes = 0;
    SlotSet leave = 0;
    for (SlotSet left = slots; left != 0;) {
      const std::uint32_t number = take_first(left);
      BatchSlot& slot = memory_.slot(number);
      const std::uint32_t word = slot.stack_child(capacity_)[--slot.stack_size];
      slot.next = word;
      const char* const line = &at<char>(word);
      for (std::size_t offset = 0; offset < sizeof(Node); offset += 64) __builtin_prefetch(line + offset);
      leave_nodes |= SlotSet{word >> 31} << number;
      leave |= SlotSet{word >> 30 & 1U} << number;
    }
    at_node_ |= slots & ~leave_nodes;
    at_leaf_ |= leave_nodes & ~leave;
    done_ |= leave;
  }

  HWY_INLINE void step_all() {
    const SlotSet stepping = std::exchange(at_node_, 0);
    for (SlotSet left = stepping; left != 0;) step(memory_.slot(take_first(left)));
    advance(stepping);
  }

  template <typename T>
  [[nodiscard]] HWY_INLINE const T& at(std::uint32_t word) const {
    return place_of<T>(units_, word);
  }

  HWY_INLINE void step(BatchSlot& slot) {
    if constexpr (kCounts) ++query_.counts[slot.index].nodes_visited;
    step_through<kAny>(at<Node>(slot.next), slot, capacity_);
    if constexpr (kCounts) {
      std::uint32_t& deepest = query_.counts[slot.index].stack_depth;
      deepest = std::max(deepest, slot.stack_size - 1);
    }
  }

  // Brings the triangles of leaves together where blocks only number their corners: asks for all corners first, so that they come side by side.
  HWY_INLINE void gather(SlotSet slots) {
    if constexpr (kGathers) {
      const Vec3* const vertices = query_.scene.vertices;
      for (SlotSet left = slots; left != 0;) {
        const auto& block = at<Block>(memory_.slot(take_first(left)).next);
        for (const auto& corner : block.vertex)
          for (const std::uint32_t vertex : corner) __builtin_prefetch(vertices + vertex);
      }
      for (SlotSet left = slots; left != 0;) {
        const std::uint32_t number = take_first(left);
        gathered_[number] = gathered(at<Block>(memory_.slot(number).next), vertices);
      }
    }
  }

  // What a slot at a leaf is to test.
  [[nodiscard]] HWY_INLINE const TriangleBlock& block_of(std::uint32_t number, const BatchSlot& slot) const {
    if constexpr (kGathers) {
      return gathered_[number];
    } else {
      return at<TriangleBlock>(slot.next);
    }
  }

  HWY_INLINE void count_leaf_of(const BatchSlot& slot, const TriangleBlock& block) {
    if constexpr (kCounts) {
      query_.counts[slot.index].primitives_tested += block.count();
      ++query_.counts[slot.index].leaves_entered;
    }
  }

  HWY_INLINE void test_leaves() {
    const SlotSet testing = std::exchange(at_leaf_, 0);
    test_leaves_of(testing);
    advance(testing);
  }

  HWY_INLINE void test_leaves_of(SlotSet testing) {
    gather(testing);
    if constexpr (kTest == TriangleTest::watertight) {
      test_watertight(testing);
    } else {
      test_fast(testing);
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
        Hit closest = hit_of(slot);
        if constexpr (kFilters) {
          take_closest(hits, block, closest, FilterOfOneRay(*query_.filter, slot.index));
        } else {
          take_closest(hits, block, closest, AcceptsAll());
        }
        put(closest, slot);
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
    if (!(t >= slot.ray.t_min && is_closer(t, primitive, hit_of(slot)))) return false;
    const float sum = candidates_.weight[0][i] + candidates_.weight[1][i] + candidates_.weight[2][i];
    Hit hit;
    hit.t = t;
    hit.u = candidates_.weight[1][i] / sum;
    hit.v = candidates_.weight[2][i] / sum;
    hit.primitive = primitive;
    if (!counts(hit, slot)) return false;
    put(hit, slot);
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
    Hit hit = hit_of(slot);
    if (!intersect_watertight(ray, triangle.corners, &block.primitive[place], hit) || !counts(hit, slot)) return false;
    put(hit, slot);
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

  static HWY_INLINE void put(const Hit& hit, BatchSlot& slot) {
    slot.t = hit.t;
    slot.u = hit.u;
    slot.v = hit.v;
    slot.primitive = hit.primitive;
  }

  static Hit hit_of(const BatchSlot& slot) {
    Hit hit;
    hit.t = slot.t;
    hit.u = slot.u;
    hit.v = slot.v;
    hit.primitive = slot.primitive;
    return hit;
  }

  // Writes results of finished rays and lets others take their slots.
  HWY_INLINE void finish() {
    // Those that follow may be finished at once.
    while (done_ != 0) {
      free_ |= done_;
      for (SlotSet left = std::exchange(done_, 0); left != 0;) {
        const BatchSlot& slot = memory_.slot(take_first(left));
        write(slot.index, hit_of(slot));
      }
      fill();
    }
  }

  void write(std::size_t index, const Hit& hit) {
    if constexpr (kAny) {
      query_.results[index] = hit ? 1 : 0;
    } else {
      query_.hits[index] = hit;
      if (!hit) query_.hits[index].t = std::numeric_limits<float>::infinity();
    }
  }

  // Gives rays to free slots: side by side where they can go so, otherwise up to kSingles.
  HWY_NOINLINE void fill() {
    for (;;) {
      if (next_ray_ == group_end_) {
        if (next_ray_ == query_.count || std::popcount(free_) < std::min<int>(kPacketRays, memory_.slot_count())) return;
        group_.prepare(query_.rays + next_ray_, std::min<std::size_t>(kPacketRays, query_.count - next_ray_));
        group_end_ += group_.count();
        if (!kCounts && !query_.scene.bvh.empty() && groups_alone_ == 0 && group_.is_packet()) {
          trace_packet();
          groups_alone_ = packet_.is_worth_it() ? 0 : kGroupsAlone;
          continue;
        }
        groups_alone_ -= groups_alone_ == 0 ? 0 : 1;
      }
      const std::size_t number = group_.count() - (group_end_ - next_ray_);
      if constexpr (kCounts) query_.counts[next_ray_] = {};
      if (!group_.is_regular(number) || query_.scene.bvh.empty()) {
        trace_alone(query_.rays[next_ray_]);
        ++next_ray_;
        continue;
      }
      if (free_ == 0 || memory_.slot_count() - std::popcount(free_) >= kSingles) return;
      const std::uint32_t slot = take_first(free_);
      take_ray(memory_.slot(slot), number);
      at_node_ |= SlotSet{1} << slot;
    }
  }

  // Puts the next ray, `number` of the group, into a slot, at the root.
  HWY_INLINE void take_ray(BatchSlot& slot, std::size_t number) {
    group_.copy(number, slot.ray);
    slot.t = query_.rays[next_ray_].t_max;
    slot.u = 0.0F;
    slot.v = 0.0F;
    slot.primitive = kInvalidId;
    slot.index = next_ray_++;
    slot.stack_size = 1;
    slot.next = 0;
  }

  // Traces the group's rays side by side, until each is alone or finished.
  HWY_INLINE void trace_packet() {
    using Rays = typename PacketWalk<Bvh>::Rays;
    packet_.take(group_, query_.rays + next_ray_);
    std::uint8_t slot_of[kPacketRays];
    SlotSet slots = 0;
    for (std::size_t i = 0; i < kPacketRays; ++i) {
      const std::uint32_t number = take_first(free_);
      slot_of[i] = static_cast<std::uint8_t>(number);
      slots |= SlotSet{1} << number;
      take_ray(memory_.slot(number), i);
    }
    const auto test_leaf = [&](std::uint32_t word, Rays rays) {
      SlotSet testing = 0;
      for (Rays left = rays; left != 0; left &= left - 1) {
        const std::uint32_t number = slot_of[std::countr_zero(left)];
        memory_.slot(number).next = word;
        testing |= SlotSet{1} << number;
      }
      test_leaves_of(testing);
      Rays finished = 0;
      for (Rays left = rays; left != 0; left &= left - 1) {
        const auto ray = static_cast<std::uint32_t>(std::countr_zero(left));
        const BatchSlot& slot = memory_.slot(slot_of[ray]);
        if constexpr (kAny) {
          finished |= Rays{slot.primitive != kInvalidId} << ray;
        } else {
          packet_.shorten(ray, slot.t);
        }
      }
      return finished;
    };
    const auto hand_over = [&](std::uint32_t word, Rays rays, const float* nears) {
      for (Rays left = rays; left != 0; left &= left - 1)
        if (memory_.slot(slot_of[std::countr_zero(left)]).stack_size > kMostHandedOver) return false;
      for (Rays left = rays; left != 0; left &= left - 1) {
        const auto ray = static_cast<std::uint32_t>(std::countr_zero(left));
        BatchSlot& slot = memory_.slot(slot_of[ray]);
        slot.stack_t()[slot.stack_size] = nears[ray];
        slot.stack_child(capacity_)[slot.stack_size++] = word;
      }
      return true;
    };
    packet_.run(test_leaf, hand_over);
    // What was handed over first is to be visited first.
    for (SlotSet left = slots; left != 0;) {
      BatchSlot& slot = memory_.slot(take_first(left));
      std::reverse(slot.stack_t() + 1, slot.stack_t() + slot.stack_size);
      std::reverse(slot.stack_child(capacity_) + 1, slot.stack_child(capacity_) + slot.stack_size);
    }
    advance(slots);
  }

  void trace_alone(const Ray& ray) {
    Hit hit;
    if (ray.is_traceable()) {
      hit.t = ray.t_max;
      const auto trace = [&](auto counter) {
        if constexpr (kAny) {
          hit.primitive = trace_any(query_.scene, ray, counter) ? 0 : kInvalidId;
        } else {
          trace_closest(query_.scene, ray, hit, counter);
        }
      };
      if constexpr (kCounts) {
        trace(Counter(query_.counts[next_ray_]));
      } else if constexpr (kFilters) {
        FilterOfOneRay of_one(*query_.filter, next_ray_);
        trace(BlockFilterCounter(of_one.filter()));
      } else {
        trace(NoCounter{});
      }
    }
    write(next_ray_, hit);
  }

  static constexpr bool kGathers = !std::is_same_v<Block, TriangleBlock>;

  const BatchQuery<Bvh>& query_;
  RayGroup<kPacketRays> group_;
  PacketWalk<Bvh> packet_;
  BatchMemory& memory_;
  const std::size_t capacity_;
  const FastUnit* const units_;
  HitCandidates candidates_;
  TriangleBlock gathered_[kGathers ? kSlots : 1];  // by slot
  SlotSet at_node_ = 0;
  SlotSet at_leaf_ = 0;
  SlotSet done_ = 0;
  SlotSet free_;
  // So many groups go on alone after one that did not stay together.
  static constexpr int kGroupsAlone = 8;
  int groups_alone_ = 0;
  std::size_t next_ray_ = 0;
  std::size_t group_end_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace grove
HWY_AFTER_NAMESPACE();

#endif
