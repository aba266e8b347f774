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
#include <utility>

#include "grove/traverse/fast_traversal.h"
#include "grove/traverse/simd/batch_slot.h"
#include "grove/traverse/simd/beside.h"
#include "grove/traverse/simd/leaf_tests-inl.h"
#include "grove/traverse/simd/node_step-inl.h"
#include "grove/traverse/simd/packet_leaves-inl.h"
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
  static constexpr bool kCounts = kBeside == Beside::counting;
  static constexpr bool kFilters = kBeside == Beside::filtering;
  using Rays = PacketRays::Set;

 public:
  BatchKernel(const BatchQuery<Bvh>& query, BatchMemory& memory)
      : query_(query),
        group_(query.scene.bvh.bounds),
        packet_(query.scene.bvh),
        memory_(memory),
        capacity_(memory.capacity()),
        units_(query.scene.bvh.units()),
        leaves_(query, memory),
        packet_leaves_(query, packet_.rays()),
        free_(memory.slot_count() == kSlots ? ~SlotSet{0} : (SlotSet{1} << memory.slot_count()) - 1) {}

  void run() {
    fill();
    finish();
    // Slots at a node are stepped until most have come to a leaf; then all leaves are tested, one after another. So the code of each
    // stays in flight, and branches go the same way.
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

  HWY_INLINE void test_leaves() {
    const SlotSet testing = std::exchange(at_leaf_, 0);
    leaves_.test(testing);
    advance(testing);
  }

  // Writes results of finished rays and lets others take their slots.
  HWY_INLINE void finish() {
    // Those that follow may be finished at once.
    while (done_ != 0) {
      free_ |= done_;
      for (SlotSet left = std::exchange(done_, 0); left != 0;) {
        const BatchSlot& slot = memory_.slot(take_first(left));
        write(slot.index, slot.hit());
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
        if (next_ray_ == query_.count || std::popcount(free_) < std::min<int>(kSingles, memory_.slot_count())) return;
        group_.prepare(query_.rays + next_ray_, std::min<std::size_t>(kPacketRays, query_.count - next_ray_));
        group_end_ += group_.count();
      }
      const std::size_t number = group_.count() - (group_end_ - next_ray_);
      if (next_ray_ == next_look_) {
        const std::size_t count = rays_side_by_side(number);
        next_look_ = std::min(next_ray_ + (count == 0 ? kHalf : count), group_end_);
        if (count != 0) {
          trace_packet(number, count);
          halves_alone_ = packet_.is_worth_it() ? 0 : kHalvesAlone;
          continue;
        }
        halves_alone_ -= halves_alone_ == 0 ? 0 : 1;
      }
      if constexpr (kCounts) query_.counts[next_ray_] = {};
      if (!group_.is_regular(number) || query_.scene.bvh.empty()) {
        trace_alone(query_.rays[next_ray_]);
        ++next_ray_;
        continue;
      }
      if (free_ == 0 || memory_.slot_count() - std::popcount(free_) >= kSingles) return;
      const std::uint32_t slot = take_first(free_);
      take_ray(memory_.slot(slot), next_ray_++, number);
      at_node_ |= SlotSet{1} << slot;
    }
  }

  // How many of the group's rays from `number` on, the beginning of a half, go side by side.
  [[nodiscard]] HWY_INLINE std::size_t rays_side_by_side(std::size_t number) const {
    if (kCounts || query_.scene.bvh.empty() || halves_alone_ != 0) return 0;
    if (number == 0 && group_.is_packet(0, kPacketRays)) return kPacketRays;
    return group_.is_packet(number, kHalf) ? kHalf : 0;
  }

  // Puts a ray, `number` of the group, into a slot, at the root.
  HWY_INLINE void take_ray(BatchSlot& slot, std::size_t index, std::size_t number) {
    group_.copy(number, slot.ray);
    slot.t = query_.rays[index].t_max;
    slot.u = 0.0F;
    slot.v = 0.0F;
    slot.primitive = kInvalidId;
    slot.index = index;
    slot.stack_size = 1;
    slot.next = 0;
  }

  // Traces `count` of the group's rays from `number` on side by side. Those that are handed over go on alone, in slots.
  HWY_INLINE void trace_packet(std::size_t number, std::size_t count) {
    const std::size_t first = next_ray_;
    packet_.take(group_, number, count, query_.rays + first);
    std::uint8_t slot_of[kPacketRays];
    SlotSet slots = 0;
    Rays with_slots = 0;
    const auto test_leaf = [&](std::uint32_t word, Rays rays) { return packet_leaves_.test(word, rays, first); };
    const auto hand_over = [&](std::uint32_t word, Rays rays, const float* nears) {
      if (std::popcount(rays & ~with_slots) > std::popcount(free_)) return false;
      for (Rays left = rays & with_slots; left != 0; left &= left - 1)
        if (memory_.slot(slot_of[std::countr_zero(left)]).stack_size > kMostHandedOver) return false;
      for (Rays left = rays; left != 0; left &= left - 1) {
        const auto ray = static_cast<std::uint32_t>(std::countr_zero(left));
        if ((with_slots >> ray & 1U) == 0) {
          const std::uint32_t slot = take_first(free_);
          slot_of[ray] = static_cast<std::uint8_t>(slot);
          slots |= SlotSet{1} << slot;
          with_slots |= Rays{1} << ray;
          take_ray(memory_.slot(slot), first + ray, number + ray);
        }
        BatchSlot& slot = memory_.slot(slot_of[ray]);
        slot.stack_t()[slot.stack_size] = nears[ray];
        slot.stack_child(capacity_)[slot.stack_size++] = word;
      }
      return true;
    };
    const Rays finished = packet_.run(test_leaf, hand_over);
    for (std::uint32_t ray = 0; ray < count; ++ray)
      if ((with_slots >> ray & 1U) == 0) write(first + ray, packet_hit(ray, finished));
    for (Rays left = with_slots; left != 0; left &= left - 1) {
      const auto ray = static_cast<std::uint32_t>(std::countr_zero(left));
      BatchSlot& slot = memory_.slot(slot_of[ray]);
      slot.take(packet_hit(ray, finished));
      // What was handed over first is to be visited first.
      std::reverse(slot.stack_t() + 1, slot.stack_t() + slot.stack_size);
      std::reverse(slot.stack_child(capacity_) + 1, slot.stack_child(capacity_) + slot.stack_size);
      if constexpr (kAny) {
        if ((finished >> ray & 1U) != 0) slot.stack_size = 1;
      } else {
        drop_what_is_farther(slot, capacity_);
      }
    }
    next_ray_ += count;
    advance(slots);
  }

  [[nodiscard]] HWY_INLINE Hit packet_hit(std::uint32_t ray, Rays finished) {
    Hit hit = packet_.rays().hit(ray);
    if (kAny && (finished >> ray & 1U) != 0) hit.primitive = 0;
    return hit;
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

  const BatchQuery<Bvh>& query_;
  RayGroup<kPacketRays> group_;
  PacketWalk<Bvh, kAny> packet_;
  BatchMemory& memory_;
  const std::size_t capacity_;
  const FastUnit* const units_;
  LeafTests<Bvh, kTest, kAny, kBeside> leaves_;
  PacketLeaves<Bvh, kTest, kAny, kBeside> packet_leaves_;
  SlotSet at_node_ = 0;
  SlotSet at_leaf_ = 0;
  SlotSet done_ = 0;
  SlotSet free_;
  static constexpr std::size_t kHalf = kPacketRays / 2;
  // So many halves of groups go on alone after a packet that did not stay together.
  static constexpr int kHalvesAlone = 8;
  int halves_alone_ = 0;
  std::size_t next_ray_ = 0;
  std::size_t next_look_ = 0;  // whether rays go side by side
  std::size_t group_end_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace grove
HWY_AFTER_NAMESPACE();

#endif
