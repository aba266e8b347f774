#pragma once

// What the kernels of all instruction sets share.

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "grove/accel/fast_bvh.h"
#include "grove/base/huge_vector.h"
#include "grove/geometry/batch_hit_filter.h"
#include "grove/geometry/hit.h"
#include "grove/geometry/traversal_counts.h"
#include "grove/traverse/fast_traversal.h"
#include "grove/traverse/simd/batch_ray.h"

namespace grove {

/// One batch: what the kernels read and write. Exactly one of `hits` and `results` is there, and at most one of `counts` and `filter`.
template <typename Bvh>
struct BatchQuery {
  FastScene<Bvh> scene;
  const Ray* rays;
  std::size_t count;
  Hit* hits;
  std::uint8_t* results;
  TraversalCounts* counts;
  const BatchHitFilter* filter = nullptr;  ///< knows triangles by their numbers in blocks
};

/// A ray's place in the kernel. Its stack follows in memory: the distances of entries, and `capacity` of them later the children.
struct alignas(64) BatchSlot {
  BatchRay ray;
  std::uint32_t next;  // the child to go to: the child's word, or kDone
  std::uint32_t stack_size;
  // The closest hit, in one register. What is farther than t is not looked for: it begins as t_max.
  alignas(16) float t;
  std::uint32_t primitive;  // or kInvalidId
  float u, v;
  std::size_t index;  // in the batch

  [[nodiscard]] Hit hit() const {
    Hit hit;
    hit.t = t;
    hit.u = u;
    hit.v = v;
    hit.primitive = primitive;
    return hit;
  }
  void take(const Hit& hit) {
    t = hit.t;
    u = hit.u;
    v = hit.v;
    primitive = hit.primitive;
  }

  [[nodiscard]] float* stack_t() { return reinterpret_cast<float*>(this + 1); }
  [[nodiscard]] std::uint32_t* stack_child(std::size_t capacity) { return reinterpret_cast<std::uint32_t*>(this + 1) + capacity; }
};

// As many rays are in flight at most, and as many of them may be alone: from 16 to 48 the speed is the same (docs/fast.md).
inline constexpr std::uint32_t kSlots = 64;
inline constexpr std::uint32_t kSingles = 32;
// So many rays can go side by side, or half of them.
inline constexpr std::uint32_t kPacketRays = 64;
// So many children a packet may hand over to a ray.
inline constexpr std::uint32_t kMostHandedOver = 24;

// Sets of slots, a bit for each. A list in memory would be written at places that depend on where rays go, and all loads behind would wait.
using SlotSet = std::uint64_t;
static_assert(kSlots <= 64);

// Takes one out of a set that is not empty.
inline std::uint32_t take_first(SlotSet& set) {
  const auto first = static_cast<std::uint32_t>(std::countr_zero(set));
  set &= set - 1;
  return first;
}

// Lies at the bottom of each stack.
inline constexpr std::uint32_t kDone = 0xc0000000U;
// Children are pushed in whole registers: so many places behind the last one are written.
inline constexpr std::size_t kSlack = 8;

/// The memory of a batch. Not touched by constructors more than needed: batches may be small.
class BatchMemory {
 public:
  /// For a hierarchy of so many levels, and so many rays.
  BatchMemory(std::uint32_t depth, std::size_t rays)
      : slot_count_(static_cast<std::uint32_t>(std::min<std::size_t>(rays, kSlots))),
        capacity_(round_up((FastNode::kWidth - 1) * (std::size_t{depth} + 1) + 1 + kMostHandedOver + kSlack)),
        stride_(sizeof(BatchSlot) + capacity_ * (sizeof(float) + sizeof(std::uint32_t)) + kOddLine),
        memory_(slot_count_ * stride_ / sizeof(FastUnit)) {
    for (std::uint32_t s = 0; s < slot_count_; ++s) {
      slots_[s] = reinterpret_cast<BatchSlot*>(reinterpret_cast<std::byte*>(memory_.data()) + s * stride_);
      slot(s).stack_t()[0] = -std::numeric_limits<float>::infinity();
      slot(s).stack_child(capacity_)[0] = kDone;
    }
  }
  [[nodiscard]] BatchSlot& slot(std::uint32_t number) { return *slots_[number]; }
  [[nodiscard]] std::uint32_t slot_count() const { return slot_count_; }
  [[nodiscard]] std::size_t capacity() const { return capacity_; }

 private:
  // To whole pairs of cache lines of both parts.
  static std::size_t round_up(std::size_t entries) { return (entries + 15) / 16 * 16; }
  // Slots are an odd number of lines apart, so that they do not compete for the same places of the cache.
  static constexpr std::size_t kOddLine = sizeof(BatchSlot) / 64 % 2 == 0 ? 64 : 0;

  std::uint32_t slot_count_;
  std::size_t capacity_;
  std::size_t stride_;
  HugeVector<FastUnit> memory_;
  BatchSlot* slots_[kSlots];
};

}  // namespace grove
