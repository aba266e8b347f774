#pragma once

// What the kernels of all instruction sets share.

#include <cstddef>
#include <cstdint>
#include <limits>

#include "grove/accel/fast_bvh.h"
#include "grove/base/huge_vector.h"
#include "grove/geometry/hit.h"
#include "grove/geometry/traversal_counts.h"
#include "grove/traverse/simd/batch_ray.h"

namespace grove {

/// One batch: what the kernels read and write. Exactly one of `hits` and `results` is there.
struct BatchQuery {
  const FastBvh& bvh;
  const Ray* rays;
  std::size_t count;
  Hit* hits;
  std::uint8_t* results;
  TraversalCounts* counts;
};

/// A ray's place in the kernel, with its part of the stack.
struct BatchSlot {
  BatchRay ray;
  Hit hit;
  std::size_t index;  // in the batch
  std::uint32_t stack_size;
  std::uint32_t next;  // the child to go to: FastChild's word, or kDone
  float* stack_t;
  std::uint32_t* stack_child;
};

// As many rays are in flight. From 16 to 48 the speed is the same (docs/fast.md).
inline constexpr std::uint32_t kSlots = 32;
// Lies at the bottom of each stack.
inline constexpr std::uint32_t kDone = 0xc0000000U;
// Children are pushed in whole registers: so many places behind the last one are written.
inline constexpr std::size_t kSlack = 8;

/// The memory of a batch. Not touched by constructors more than needed: batches may be small.
class BatchMemory {
 public:
  explicit BatchMemory(const FastBvh& bvh)
      : capacity_((FastNode::kWidth - 1) * (bvh.depth + 1) + 1 + kSlack),
        slots_(kSlots),
        stack_t_(kSlots * capacity_),
        stack_child_(kSlots * capacity_) {
    for (std::size_t s = 0; s < kSlots; ++s) {
      slots_[s].stack_t = stack_t_.data() + s * capacity_;
      slots_[s].stack_child = stack_child_.data() + s * capacity_;
      slots_[s].stack_t[0] = -std::numeric_limits<float>::infinity();
      slots_[s].stack_child[0] = kDone;
    }
  }
  [[nodiscard]] BatchSlot* slots() { return slots_.data(); }

 private:
  std::size_t capacity_;
  HugeVector<BatchSlot> slots_;
  HugeVector<float> stack_t_;
  HugeVector<std::uint32_t> stack_child_;
};

}  // namespace grove
