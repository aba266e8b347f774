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
#include <cstring>
#include <limits>

#include "grove/traverse/fast_traversal.h"
#include "grove/traverse/simd/batch_slot.h"
#include "grove/traverse/simd/block_test-inl.h"
#include "grove/traverse/simd/compaction-inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// kAny: any hit instead of the closest. kCounts: with counters.
template <bool kAny, bool kCounts>
class BatchKernel {
 public:
  BatchKernel(const BatchQuery& query, BatchSlot* slots)
      : query_(query),
        bounds_(query.bvh.bounds),
        slots_(slots),
        nodes_(query.bvh.nodes.data()),
        blocks_(query.bvh.blocks.data()),
        blocks_offset_(static_cast<std::ptrdiff_t>(reinterpret_cast<std::uintptr_t>(blocks_) - reinterpret_cast<std::uintptr_t>(nodes_))) {}

  void run() {
    for (std::uint32_t slot = 0; slot < kSlots; ++slot) refill(slot);
    // Slots at a node are stepped until most have come to a leaf; then all leaves are tested, one after another. So the code of each
    // stays in flight, and branches go the same way.
    while (count_[at_node] + count_[at_leaf] > 0) {
      const std::uint32_t few = (count_[at_node] + count_[at_leaf]) / 3;
      while (count_[at_node] > few || (count_[at_node] > 0 && count_[at_leaf] == 0)) {
        std::uint32_t stepping[kSlots];
        const std::uint32_t stepping_count = take(at_node, stepping);
        for (std::uint32_t i = 0; i < stepping_count; ++i) {
          step(slots_[stepping[i]]);
          enlist(stepping[i]);
        }
        finish();
      }
      std::uint32_t testing[kSlots];
      const std::uint32_t testing_count = take(at_leaf, testing);
      test_leaves(testing, testing_count);
      finish();
    }
  }

 private:
  // The two highest bits of a child's word.
  enum Place : std::uint32_t { at_node = 0, at_leaf = 2, finished = 3 };

  std::uint32_t take(Place place, std::uint32_t* slots) {
    const std::uint32_t count = count_[place];
    std::memcpy(slots, lists_[place], count * sizeof *slots);
    count_[place] = 0;
    return count;
  }

  // Fetches what the slot goes to next, and notes it in the list for that.
  HWY_INLINE void enlist(std::uint32_t number) {
    const std::uint32_t word = slots_[number].next;
    // Without a branch, which could not be foreseen: offsets from the nodes.
    const std::ptrdiff_t node = std::ptrdiff_t{word} * static_cast<std::ptrdiff_t>(sizeof(FastNode));
    const std::ptrdiff_t block = blocks_offset_ + std::ptrdiff_t{(word & ~kDone) >> 2} * static_cast<std::ptrdiff_t>(sizeof(TriangleBlock));
    const std::ptrdiff_t is_leaf = -static_cast<std::ptrdiff_t>(word >> 31);
    const char* const line = reinterpret_cast<const char*>(nodes_) + (node ^ ((node ^ block) & is_leaf));
    __builtin_prefetch(line);
    __builtin_prefetch(line + 64);
    __builtin_prefetch(line + 128);
    __builtin_prefetch(line + 192);
    const std::uint32_t place = word >> 30;
    lists_[place][count_[place]++] = number;
  }

  // Steps through a node: pushes the children that are met, the nearest last, and takes the last.
  HWY_INLINE void step(BatchSlot& slot) {
    const FastNode& node = nodes_[slot.next];
    if constexpr (kCounts) ++query_.counts[slot.index].nodes_visited;
    const hn::CappedTag<float, FastNode::kWidth> d;
    if constexpr (hn::MaxLanes(d) == FastNode::kWidth) {
      const auto [near, far] = slabs(d, node, slot, 0);
      push_in_one(d, node, slot, near, far);
    } else {
      HWY_ALIGN float near_of[FastNode::kWidth];
      std::uint32_t met = 0;
      for (std::size_t first = 0; first < FastNode::kWidth; first += hn::MaxLanes(d)) {
        const auto [near, far] = slabs(d, node, slot, first);
        hn::Store(near, d, near_of + first);
        met |= bits_of(d, hn::Le(near, far)) << first;
      }
      push_one_by_one(node, slot, near_of, met);
    }
    if constexpr (kCounts) {
      std::uint32_t& deepest = query_.counts[slot.index].stack_depth;
      deepest = std::max(deepest, slot.stack_size);
    }
  }

  template <typename V>
  struct Interval {
    V near;
    V far;
  };

  template <typename D, typename V = hn::Vec<D>>
  HWY_INLINE Interval<V> slabs(D d, const FastNode& node, const BatchSlot& slot, std::size_t first) {
    V near = hn::Set(d, slot.ray.t_min);
    V far = hn::Set(d, slot.hit.t);
    const float* const rows = &node.planes[0][0][0];
    for (int axis = 0; axis < 3; ++axis) {
      const V inverse = hn::Set(d, slot.ray.inverse[axis]);
      const V near_planes = hn::LoadU(d, rows + slot.ray.planes[0][axis] + first);
      const V far_planes = hn::LoadU(d, rows + slot.ray.planes[1][axis] + first);
      near = hn::Max(near, hn::MulAdd(near_planes, inverse, hn::Set(d, slot.ray.offset[0][axis])));
      far = hn::Min(far, hn::MulAdd(far_planes, inverse, hn::Set(d, slot.ray.offset[1][axis])));
    }
    return {near, far};
  }

  template <typename D, typename V>
  HWY_INLINE void push_in_one(D d, const FastNode& node, BatchSlot& slot, V near, V far) {
    const hn::RebindToUnsigned<D> du;
    auto children = hn::LoadU(du, reinterpret_cast<const std::uint32_t*>(node.child));
    auto met = hn::Le(near, far);
    if constexpr (!kAny) {
      // Any hit needs no order: it costs more than it saves.
      const auto places = hn::And(hn::Set(du, node.order[slot.ray.octant]) >> hn::Mul(hn::Iota(du, 0), hn::Set(du, 3)), hn::Set(du, 7));
      const auto order = hn::IndicesFromVec(d, places);
      const V missed = hn::Set(d, std::numeric_limits<float>::infinity());
      near = hn::TableLookupLanes(hn::IfThenElse(met, near, missed), order);
      children = hn::TableLookupLanes(children, hn::IndicesFromVec(du, places));
      met = hn::Lt(near, missed);
    }
    const Compaction<D> compaction(d, met);
    if constexpr (!kAny) hn::StoreU(compaction(d, near), d, slot.stack_t + slot.stack_size);
    hn::StoreU(compaction(du, children), du, slot.stack_child + slot.stack_size);
    // The next is not read from the stack when it has just been pushed there: a narrow load would have to wait for the wide store.
    const std::uint32_t count = compaction.count();
    const std::uint32_t last = kHighestBit[compaction.bits()];
    const std::uint32_t place = kAny ? last : node.order[slot.ray.octant] >> (3 * last) & 7U;
    const std::uint32_t pushed = word_of(node.child[place]);
    const std::uint32_t waiting = slot.stack_child[slot.stack_size - 1];
    slot.next = count > 0 ? pushed : waiting;
    slot.stack_size += count - 1;
  }

  static std::uint32_t word_of(FastChild child) { return std::bit_cast<std::uint32_t>(child); }

  HWY_INLINE void push_one_by_one(const FastNode& node, BatchSlot& slot, const float* near, std::uint32_t met) {
    const std::uint32_t order = node.order[slot.ray.octant];
    for (int k = 0; k < FastNode::kWidth; ++k) {
      const std::uint32_t place = order >> (3 * k) & 7U;
      slot.stack_t[slot.stack_size] = near[place];
      slot.stack_child[slot.stack_size] = word_of(node.child[place]);
      slot.stack_size += met >> place & 1U;
    }
    slot.next = slot.stack_child[--slot.stack_size];
  }

  // Tests the leaves of all slots in a list: first which triangles may be hit at all, for all of them without a branch; then those that may.
  HWY_INLINE void test_leaves(const std::uint32_t* numbers, std::uint32_t number_count) {
    struct Candidates {
      std::uint32_t slot;
      std::uint32_t triangles;
    };
    Candidates candidates[kSlots];
    std::uint32_t candidate_count = 0;
    for (std::uint32_t i = 0; i < number_count; ++i) {
      BatchSlot& slot = slots_[numbers[i]];
      const std::uint32_t count = (slot.next & 3U) + 1;
      if constexpr (kCounts) {
        query_.counts[slot.index].primitives_tested += count;
        ++query_.counts[slot.index].leaves_entered;
      }
      const std::uint32_t triangles = filter_block(slot.ray, slot.hit.t, block_of(slot)) & ((1U << count) - 1);
      candidates[candidate_count] = {numbers[i], triangles};
      candidate_count += triangles != 0 ? 1 : 0;
    }
    for (std::uint32_t i = 0; i < candidate_count; ++i) settle(slots_[candidates[i].slot], candidates[i].triangles);
    for (std::uint32_t i = 0; i < number_count; ++i) {
      BatchSlot& slot = slots_[numbers[i]];
      slot.next = slot.stack_child[--slot.stack_size];
      enlist(numbers[i]);
    }
  }

  [[nodiscard]] const TriangleBlock& block_of(const BatchSlot& slot) const { return blocks_[(slot.next & ~kDone) >> 2]; }

  HWY_INLINE void settle(BatchSlot& slot, std::uint32_t candidates) {
    const TriangleBlock& block = block_of(slot);
    const BlockHits hits = test_block(slot.ray, block);
    bool found = false;
    for (std::uint32_t known = candidates & hits.known; known != 0; known &= known - 1) {
      const auto place = static_cast<std::uint32_t>(std::countr_zero(known));
      const float t = hits.t[place];
      if constexpr (kAny) {
        found = found || (t >= slot.ray.t_min && t <= slot.hit.t && t < std::numeric_limits<float>::infinity());
        continue;
      }
      if (!(t >= slot.ray.t_min && is_closer(t, block.primitive[place], slot.hit))) continue;
      const float sum = hits.weight[0][place] + hits.weight[1][place] + hits.weight[2][place];
      slot.hit.t = t;
      slot.hit.u = hits.weight[1][place] / sum;
      slot.hit.v = hits.weight[2][place] / sum;
      slot.hit.primitive = block.primitive[place];
      found = true;
    }
    for (std::uint32_t others = candidates & ~hits.known; others != 0; others &= others - 1)
      found = test_alone(slot, block, static_cast<std::uint32_t>(std::countr_zero(others))) || found;
    if (!found) return;
    if constexpr (kAny) {
      slot.hit.primitive = 0;
      slot.stack_size = 1;
    } else {
      drop_what_is_farther(slot);
    }
  }

  HWY_NOINLINE static bool test_alone(BatchSlot& slot, const TriangleBlock& block, std::uint32_t place) {
    const WatertightRay ray = slot.ray.triangle_ray();
    const SingleTriangle triangle = triangle_in(block, place);
    if constexpr (kAny) return occluded_watertight(ray, triangle.corners);
    return intersect_watertight(ray, triangle.corners, &block.primitive[place], slot.hit);
  }

  // A tie must still be visited: the primitive there may have a lower id.
  static void drop_what_is_farther(BatchSlot& slot) {
    const hn::CappedTag<float, kSlack> d;
    const hn::RebindToUnsigned<decltype(d)> du;
    using Front = Compaction<hn::CappedTag<float, kSlack>>;
    const std::uint32_t size = slot.stack_size;
    std::uint32_t kept = 0;
    if constexpr (Front::kIsThere) {
      for (std::uint32_t i = 0; i < size; i += 8) {
        const auto t = hn::LoadU(d, slot.stack_t + i);
        const auto child = hn::LoadU(du, slot.stack_child + i);
        const Front front(d, hn::And(hn::Le(t, hn::Set(d, slot.hit.t)), hn::FirstN(d, size - i)));
        hn::StoreU(front(d, t), d, slot.stack_t + kept);
        hn::StoreU(front(du, child), du, slot.stack_child + kept);
        kept += front.count();
      }
    } else {
      for (std::uint32_t i = 0; i < size; ++i) {
        slot.stack_t[kept] = slot.stack_t[i];
        slot.stack_child[kept] = slot.stack_child[i];
        kept += slot.stack_t[i] <= slot.hit.t ? 1 : 0;
      }
    }
    slot.stack_size = kept;
  }

  // Writes results of finished rays and lets others take their slots.
  void finish() {
    std::uint32_t done[kSlots];
    const std::uint32_t done_count = take(Place::finished, done);
    for (std::uint32_t i = 0; i < done_count; ++i) {
      write(slots_[done[i]].index, slots_[done[i]].hit);
      refill(done[i]);
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

  // Takes the next ray that needs the kernel, if there is one, and does those on the way that do not.
  void refill(std::uint32_t number) {
    BatchSlot& slot = slots_[number];
    for (; next_ray_ < query_.count; ++next_ray_) {
      const Ray& ray = query_.rays[next_ray_];
      if constexpr (kCounts) query_.counts[next_ray_] = {};
      if (!slot.ray.set(ray, bounds_) || query_.bvh.nodes.empty()) {
        trace_alone(ray);
        continue;
      }
      slot.hit = Hit{};
      slot.hit.t = ray.t_max;
      slot.index = next_ray_++;
      slot.stack_size = 1;
      slot.next = 0;
      lists_[at_node][count_[at_node]++] = number;
      return;
    }
  }

  void trace_alone(const Ray& ray) {
    Hit hit;
    if (ray.is_traceable()) {
      hit.t = ray.t_max;
      const auto trace = [&](auto counter) {
        if constexpr (kAny) {
          hit.primitive = trace_any(query_.bvh, ray, counter) ? 0 : kInvalidId;
        } else {
          trace_closest(query_.bvh, ray, hit, counter);
        }
      };
      if constexpr (kCounts) {
        trace(Counter(query_.counts[next_ray_]));
      } else {
        trace(NoCounter{});
      }
    }
    write(next_ray_, hit);
  }

  const BatchQuery& query_;
  const BatchBounds bounds_;
  BatchSlot* const slots_;
  const FastNode* const nodes_;
  const TriangleBlock* const blocks_;
  const std::ptrdiff_t blocks_offset_;  // from the nodes, in bytes
  std::uint32_t lists_[4][kSlots];
  std::uint32_t count_[4] = {};
  std::size_t next_ray_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace grove
HWY_AFTER_NAMESPACE();

#endif
