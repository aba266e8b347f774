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
#include <utility>

#include "grove/traverse/fast_traversal.h"
#include "grove/traverse/simd/batch_slot.h"
#include "grove/traverse/simd/block_test-inl.h"
#include "grove/traverse/simd/compaction-inl.h"
#include "grove/traverse/simd/ray_setup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// kAny: any hit instead of the closest. kCounts: with counters.
template <bool kAny, bool kCounts>
class BatchKernel {
 public:
  BatchKernel(const BatchQuery& query, BatchMemory& memory)
      : query_(query), setup_(query.bvh.bounds), memory_(memory), capacity_(memory.capacity()), units_(query.bvh.units()) {}

  void run() {
    for (std::uint32_t slot = 0; slot < kSlots; ++slot) refill(slot);
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
  // Sets of slots, a bit for each. A list in memory would be written at places that depend on where rays go, and all loads behind would wait.
  using SlotSet = std::uint32_t;
  static_assert(kSlots <= 32);

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
      __builtin_prefetch(line);
      __builtin_prefetch(line + 64);
      __builtin_prefetch(line + 128);
      __builtin_prefetch(line + 192);
      leave_nodes |= (word >> 31) << number;
      leave |= (word >> 30 & 1U) << number;
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

  // Where a node or block lies: the highest two bits are shifted out.
  template <typename T>
  [[nodiscard]] HWY_INLINE const T& at(std::uint32_t word) const {
    const std::size_t offset = std::size_t{word << 2} * (sizeof(FastUnit) / 4);
    return *reinterpret_cast<const T*>(reinterpret_cast<const char*>(units_) + offset);
  }

  // Steps through a node: pushes the children that are met, the nearest last.
  HWY_INLINE void step(BatchSlot& slot) {
    const auto& node = at<FastNode>(slot.next);
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
      deepest = std::max(deepest, slot.stack_size - 1);
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
    V far = hn::Set(d, slot.t);
    const float* const rows = &node.planes[0][0][0];
    for (int axis = 0; axis < 3; ++axis) {
      const V inverse = hn::Set(d, slot.ray.inverse[axis]);
      const V near_planes = hn::LoadU(d, rows + slot.ray.rows.near[axis] + first);
      const V far_planes = hn::LoadU(d, rows + slot.ray.rows.far[axis] + first);
      near = hn::Max(near, hn::MulAdd(near_planes, inverse, hn::Set(d, slot.ray.near_offset[axis])));
      far = hn::Min(far, hn::MulAdd(far_planes, inverse, hn::Set(d, slot.ray.far_offset[axis])));
    }
    return {near, far};
  }

  template <typename D, typename V>
  HWY_INLINE void push_in_one(D d, const FastNode& node, BatchSlot& slot, V near, V far) {
    const hn::RebindToUnsigned<D> du;
    const auto children = hn::LoadU(du, reinterpret_cast<const std::uint32_t*>(node.child));
    std::uint32_t* const stack_child = slot.stack_child(capacity_);
    const std::uint32_t size = slot.stack_size;
    std::uint32_t met = 0;
    if constexpr (kAny) {
      // Any hit needs no order: it costs more than it saves.
      met = bits_of(d, hn::Le(near, far));
      hn::StoreU(look_up(du, children, front_places(du, met)), du, stack_child + size);
    } else {
      const auto order = hn::Set(du, node.order[slot.ray.rows.octant]) >> hn::Mul(hn::Iota(du, 0), hn::Set(du, 3));
      // The sign of the difference goes through the same order as the children. Unused places have a difference of minus infinity.
      const V slack = look_up(d, hn::Sub(far, near), order);
      met = ~bits_of(d, hn::Lt(slack, hn::Zero(d))) & 0xffU;
      const auto places = look_up(du, order, front_places(du, met));
      hn::StoreU(look_up(d, near, places), d, slot.stack_t() + size);
      hn::StoreU(look_up(du, children, places), du, stack_child + size);
    }
    slot.stack_size = size + static_cast<std::uint32_t>(std::popcount(met));
  }

  static std::uint32_t word_of(FastChild child) { return std::bit_cast<std::uint32_t>(child); }

  HWY_INLINE void push_one_by_one(const FastNode& node, BatchSlot& slot, const float* near, std::uint32_t met) {
    const std::uint32_t order = node.order[slot.ray.rows.octant];
    std::uint32_t* const stack_child = slot.stack_child(capacity_);
    std::uint32_t size = slot.stack_size;
    for (int k = 0; k < FastNode::kWidth; ++k) {
      const std::uint32_t place = order >> (3 * k) & 7U;
      slot.stack_t()[size] = near[place];
      stack_child[size] = word_of(node.child[place]);
      size += met >> place & 1U;
    }
    slot.stack_size = size;
  }

  // Tests the leaves of all slots in a list: first which triangles may be hit at all, for all of them without a branch; then those that may.
  HWY_INLINE void test_leaves() {
    const SlotSet testing = std::exchange(at_leaf_, 0);
    std::uint8_t possible[kSlots];
    SlotSet settling = 0;
    for (SlotSet left = testing; left != 0;) {
      const std::uint32_t number = take_first(left);
      BatchSlot& slot = memory_.slot(number);
      const auto& block = at<TriangleBlock>(slot.next);
      if constexpr (kCounts) {
        query_.counts[slot.index].primitives_tested += block.count();
        ++query_.counts[slot.index].leaves_entered;
      }
      const BlockFilter filter = filter_block<kAny>(slot.ray, slot.t, block);
      bool is_open = filter.possible != 0;
      if constexpr (kAny) {
        // Whatever the distance is exactly, it is in range.
        slot.primitive = filter.certain != 0 ? 0 : slot.primitive;
        slot.stack_size = filter.certain != 0 ? 1 : slot.stack_size;
        is_open = is_open && filter.certain == 0;
      }
      possible[number] = static_cast<std::uint8_t>(filter.possible);
      settling |= (is_open ? 1U : 0U) << number;
    }
    settle(settling, possible);
    advance(testing);
  }

  // Tests the possible triangles of slots, and shortens the stacks of those that are hit.
  HWY_INLINE void settle(SlotSet settling, const std::uint8_t* possible) {
    SlotSet hit = 0;
    while (settling != 0) {
      const std::uint32_t number = take_first(settling);
      const BatchSlot& slot = memory_.slot(number);
      for (std::uint32_t left = possible[number]; left != 0; left &= left - 1) {
        candidates_.append(number, slot.ray, at<TriangleBlock>(slot.next), static_cast<std::uint32_t>(std::countr_zero(left)));
        if (candidates_.is_full()) hit |= test_appended();
      }
    }
    hit |= test_appended();
    while (hit != 0) {
      BatchSlot& slot = memory_.slot(take_first(hit));
      if constexpr (kAny) {
        slot.stack_size = 1;
      } else {
        drop_what_is_farther(slot);
      }
    }
  }

  // Returns whose hits are new.
  HWY_INLINE SlotSet test_appended() {
    test_candidates(candidates_);
    SlotSet hit = 0;
    for (std::size_t i = 0; i < candidates_.count; ++i) {
      const std::uint32_t number = candidates_.slot[i];
      BatchSlot& slot = memory_.slot(number);
      const bool is_hit = (candidates_.known >> i & 1U) != 0 ? take_hit(slot, i) : test_alone(slot, candidates_.place[i]);
      hit |= (is_hit ? 1U : 0U) << number;
    }
    candidates_.count = 0;
    return hit;
  }

  HWY_INLINE bool take_hit(BatchSlot& slot, std::size_t i) {
    const float t = candidates_.t[i];
    if constexpr (kAny) {
      if (!(t >= slot.ray.t_min && t <= slot.t && t < std::numeric_limits<float>::infinity())) return false;
      slot.primitive = 0;
      return true;
    }
    const std::uint32_t primitive = at<TriangleBlock>(slot.next).primitive[candidates_.place[i]];
    if (!(t >= slot.ray.t_min && is_closer(t, primitive, hit_of(slot)))) return false;
    const float sum = candidates_.weight[0][i] + candidates_.weight[1][i] + candidates_.weight[2][i];
    slot.t = t;
    slot.u = candidates_.weight[1][i] / sum;
    slot.v = candidates_.weight[2][i] / sum;
    slot.primitive = primitive;
    return true;
  }

  HWY_NOINLINE bool test_alone(BatchSlot& slot, std::uint32_t place) const {
    const auto& block = at<TriangleBlock>(slot.next);
    const WatertightRay ray = slot.ray.triangle_ray();
    const SingleTriangle triangle = triangle_in(block, place);
    if constexpr (kAny) {
      if (!occluded_watertight(ray, triangle.corners)) return false;
      slot.primitive = 0;
      return true;
    }
    Hit hit = hit_of(slot);
    if (!intersect_watertight(ray, triangle.corners, &block.primitive[place], hit)) return false;
    slot.t = hit.t;
    slot.u = hit.u;
    slot.v = hit.v;
    slot.primitive = hit.primitive;
    return true;
  }

  static Hit hit_of(const BatchSlot& slot) {
    Hit hit;
    hit.t = slot.t;
    hit.u = slot.u;
    hit.v = slot.v;
    hit.primitive = slot.primitive;
    return hit;
  }

  // A tie must still be visited: the primitive there may have a lower id.
  HWY_INLINE void drop_what_is_farther(BatchSlot& slot) {
    float* const stack_t = slot.stack_t();
    std::uint32_t* const stack_child = slot.stack_child(capacity_);
    const std::uint32_t size = slot.stack_size;
    std::uint32_t kept = 0;
    const hn::CappedTag<float, kSlack> d;
    if constexpr (hn::MaxLanes(d) == kSlack) {
      const hn::RebindToUnsigned<decltype(d)> du;
      for (std::uint32_t i = 0; i < size; i += kSlack) {
        const auto t = hn::LoadU(d, stack_t + i);
        const auto child = hn::LoadU(du, stack_child + i);
        const std::uint32_t near = bits_of(d, hn::And(hn::Le(t, hn::Set(d, slot.t)), hn::FirstN(d, size - i)));
        const auto places = front_places(du, near);
        hn::StoreU(look_up(d, t, places), d, stack_t + kept);
        hn::StoreU(look_up(du, child, places), du, stack_child + kept);
        kept += static_cast<std::uint32_t>(std::popcount(near));
      }
    } else {
      for (std::uint32_t i = 0; i < size; ++i) {
        stack_t[kept] = stack_t[i];
        stack_child[kept] = stack_child[i];
        kept += stack_t[i] <= slot.t ? 1 : 0;
      }
    }
    slot.stack_size = kept;
  }

  // Writes results of finished rays and lets others take their slots.
  void finish() {
    for (SlotSet left = std::exchange(done_, 0); left != 0;) {
      const std::uint32_t number = take_first(left);
      const BatchSlot& slot = memory_.slot(number);
      write(slot.index, hit_of(slot));
      refill(number);
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
    BatchSlot& slot = memory_.slot(number);
    for (; next_ray_ < query_.count; ++next_ray_) {
      const Ray& ray = query_.rays[next_ray_];
      if (next_ray_ % RaySetup::kCount == 0) setup_.prepare(&ray, std::min(RaySetup::kCount, query_.count - next_ray_));
      if constexpr (kCounts) query_.counts[next_ray_] = {};
      if (!setup_.is_regular(next_ray_ % RaySetup::kCount) || query_.bvh.empty()) {
        trace_alone(ray);
        continue;
      }
      setup_.copy(next_ray_ % RaySetup::kCount, slot.ray);
      slot.t = ray.t_max;
      slot.u = 0.0F;
      slot.v = 0.0F;
      slot.primitive = kInvalidId;
      slot.index = next_ray_++;
      slot.stack_size = 1;
      slot.next = 0;
      at_node_ |= SlotSet{1} << number;
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
  RaySetup setup_;
  BatchMemory& memory_;
  const std::size_t capacity_;
  const FastUnit* const units_;
  HitCandidates candidates_;
  SlotSet at_node_ = 0;
  SlotSet at_leaf_ = 0;
  SlotSet done_ = 0;
  std::size_t next_ray_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace grove
HWY_AFTER_NAMESPACE();

#endif
