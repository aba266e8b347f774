// A ray's step through a node of the fast path, on the stack of its slot. Included once for each instruction set.

#if defined(GROVE_NODE_STEP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_NODE_STEP_INL_H
#undef GROVE_NODE_STEP_INL_H
#else
#define GROVE_NODE_STEP_INL_H
#endif

#include <hwy/highway.h>

#include <bit>

#include "grove/traverse/simd/batch_slot.h"
#include "grove/traverse/simd/compaction-inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Where a node or block lies: the highest two bits are shifted out.
template <typename T>
[[nodiscard]] HWY_INLINE const T& place_of(const FastUnit* units, std::uint32_t word) {
  const std::size_t offset = std::size_t{word << 2} * (sizeof(FastUnit) / 4);
  return *reinterpret_cast<const T*>(reinterpret_cast<const char*>(units) + offset);
}

template <typename V>
struct Interval {
  V near;
  V far;
};

// What the slabs of nodes are tested with, in all lanes.
template <typename D>
struct SlabRay {
  hn::Vec<D> inverse[3];
  hn::Vec<D> near_offset[3];
  hn::Vec<D> far_offset[3];
  hn::Vec<D> t_min;
};

template <typename D>
HWY_INLINE SlabRay<D> slab_ray(D d, const BatchRay& ray) {
  SlabRay<D> lanes;
  for (int axis = 0; axis < 3; ++axis) {
    lanes.inverse[axis] = hn::Set(d, ray.inverse[axis]);
    lanes.near_offset[axis] = hn::Set(d, ray.near_offset[axis]);
    lanes.far_offset[axis] = hn::Set(d, ray.far_offset[axis]);
  }
  lanes.t_min = hn::Set(d, ray.t_min);
  return lanes;
}

// Where the ray is within the slabs of a node's children, from t_min to `t`.
template <typename D, typename V = hn::Vec<D>>
HWY_INLINE Interval<V> slabs(D d, const FastNode& node, const SlabRay<D>& ray, const PlaneRows& rows, V t, std::size_t first) {
  V near = ray.t_min;
  V far = t;
  const float* const planes = &node.bounds.planes[0][0][0];
  for (int axis = 0; axis < 3; ++axis) {
    const V near_planes = hn::LoadU(d, planes + rows.near[axis] + first);
    const V far_planes = hn::LoadU(d, planes + rows.far(axis) + first);
    near = hn::Max(near, hn::MulAdd(near_planes, ray.inverse[axis], ray.near_offset[axis]));
    far = hn::Min(far, hn::MulAdd(far_planes, ray.inverse[axis], ray.far_offset[axis]));
  }
  return {near, far};
}

// A plane is met at  (origin + step * scale) * inverse + offset,  of which all but the step is the same for the children. That rounds once more than
// planes in floats do, by 1 u of the reach: ray_setup-inl.h has seven to spare.
template <typename D, typename V = hn::Vec<D>>
HWY_INLINE Interval<V> slabs(D d, const CompressedNode& node, const SlabRay<D>& ray, const PlaneRows& rows, V t, std::size_t first) {
  const hn::RebindToUnsigned<D> du;
  const hn::RebindToSigned<D> di;
  const hn::Rebind<std::uint8_t, D> d8;
  V near = ray.t_min;
  V far = t;
  const std::uint8_t* const steps = &node.steps[0][0][0];
  for (int axis = 0; axis < 3; ++axis) {
    const V origin = hn::Set(d, node.origin[axis]);
    const V scale = hn::BitCast(d, hn::Set(du, std::uint32_t{node.scale[axis]} << 16));
    const V step = hn::Mul(scale, ray.inverse[axis]);
    const V near_steps = hn::ConvertTo(d, hn::PromoteTo(di, hn::LoadU(d8, steps + rows.near[axis] + first)));
    const V far_steps = hn::ConvertTo(d, hn::PromoteTo(di, hn::LoadU(d8, steps + rows.far(axis) + first)));
    near = hn::Max(near, hn::MulAdd(near_steps, step, hn::MulAdd(origin, ray.inverse[axis], ray.near_offset[axis])));
    far = hn::Min(far, hn::MulAdd(far_steps, step, hn::MulAdd(origin, ray.inverse[axis], ray.far_offset[axis])));
  }
  return {near, far};
}

// Which places of a node are used, as they are and as its orders have them. A whole box tells by itself; one on a grid does not where the grid is
// finer than what rays are padded by.
HWY_INLINE AllLanes used_places(const FastNode& /*node*/) {
  return {};
}
HWY_INLINE std::uint32_t used_places(const CompressedNode& node) {
  return node.used;
}
HWY_INLINE AllLanes used_places_in_order(const FastNode& /*node*/) {
  return {};
}
HWY_INLINE std::uint32_t used_places_in_order(const CompressedNode& node) {
  return node.used_in_order;
}

template <bool kAny, typename Node, typename D, typename V>
HWY_INLINE void push_in_one(D d, const Node& node, BatchSlot& slot, std::size_t capacity, V near, V far) {
  const hn::RebindToUnsigned<D> du;
  const auto children = hn::LoadU(du, reinterpret_cast<const std::uint32_t*>(node.child));
  std::uint32_t* const stack_child = slot.stack_child(capacity);
  const std::uint32_t size = slot.stack_size;
  std::uint32_t met = 0;
  if constexpr (kAny) {
    // The largest comes last; an order by distance costs more than it saves.
    const LaneSet set(d, hn::Le(near, far), used_places(node));
    met = set.bits();
    hn::StoreU(set.to_front(du, children), du, stack_child + size);
  } else {
    const auto order = hn::Set(du, node.order_for(slot.ray.rows.octant)) >> hn::Mul(hn::Iota(du, 0), hn::Set(du, 3));
    const V near_in_order = look_up(d, near, order);
    const LaneSet set(d, hn::Le(near_in_order, look_up(d, far, order)), used_places_in_order(node));
    met = set.bits();
    hn::StoreU(set.to_front(d, near_in_order), d, slot.stack_t() + size);
    hn::StoreU(set.to_front(du, look_up(du, children, order)), du, stack_child + size);
  }
  slot.stack_size = size + static_cast<std::uint32_t>(std::popcount(met));
}

// In which order rays of an octant push children: far to near, or for any hit small to large, as they are.
template <bool kAny, typename Node>
HWY_INLINE std::uint32_t pushing_order(const Node& node, std::uint32_t octant) {
  constexpr std::uint32_t kInPlace = 076543210;
  return kAny ? kInPlace : node.order_for(octant);
}

template <bool kAny, typename Node>
HWY_INLINE void push_one_by_one(const Node& node, BatchSlot& slot, std::size_t capacity, const float* near, std::uint32_t met) {
  const std::uint32_t order = pushing_order<kAny>(node, slot.ray.rows.octant);
  std::uint32_t* const stack_child = slot.stack_child(capacity);
  std::uint32_t size = slot.stack_size;
  for (int k = 0; k < FastNode::kWidth; ++k) {
    const std::uint32_t place = order >> (3 * k) & 7U;
    slot.stack_t()[size] = near[place];
    stack_child[size] = std::bit_cast<std::uint32_t>(node.child[place]);
    size += met >> place & 1U;
  }
  slot.stack_size = size;
}

// Pushes the children that are met, the nearest last, or for any hit the largest. `capacity` is that of the slot's stack.
template <bool kAny, typename Node>
HWY_INLINE void step_through(const Node& node, BatchSlot& slot, std::size_t capacity) {
  const hn::CappedTag<float, FastNode::kWidth> d;
  const auto ray = slab_ray(d, slot.ray);
  const auto t = hn::Set(d, slot.t);
  if constexpr (hn::MaxLanes(d) == FastNode::kWidth) {
    const auto [near, far] = slabs(d, node, ray, slot.ray.rows, t, 0);
    push_in_one<kAny>(d, node, slot, capacity, near, far);
  } else {
    HWY_ALIGN float near_of[FastNode::kWidth];
    std::uint32_t met = 0;
    for (std::size_t first = 0; first < FastNode::kWidth; first += hn::MaxLanes(d)) {
      const auto [near, far] = slabs(d, node, ray, slot.ray.rows, t, first);
      hn::Store(near, d, near_of + first);
      met |= bits_of(d, hn::Le(near, far)) << first;
    }
    push_one_by_one<kAny>(node, slot, capacity, near_of, used_places(node) & met);
  }
}

// Takes from the stack what begins behind the hit. A tie must still be visited: the primitive there may have a lower id.
HWY_INLINE void drop_what_is_farther(BatchSlot& slot, std::size_t capacity) {
  float* const stack_t = slot.stack_t();
  std::uint32_t* const stack_child = slot.stack_child(capacity);
  const std::uint32_t size = slot.stack_size;
  std::uint32_t kept = 0;
  const hn::CappedTag<float, kSlack> d;
  if constexpr (hn::MaxLanes(d) == kSlack) {
    const hn::RebindToUnsigned<decltype(d)> du;
    for (std::uint32_t i = 0; i < size; i += kSlack) {
      const auto t = hn::LoadU(d, stack_t + i);
      const LaneSet near(d, hn::And(hn::Le(t, hn::Set(d, slot.t)), hn::FirstN(d, size - i)), AllLanes());
      const auto child = hn::LoadU(du, stack_child + i);
      hn::StoreU(near.to_front(d, t), d, stack_t + kept);
      hn::StoreU(near.to_front(du, child), du, stack_child + kept);
      kept += static_cast<std::uint32_t>(std::popcount(near.bits()));
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

}  // namespace HWY_NAMESPACE
}  // namespace grove
HWY_AFTER_NAMESPACE();

#endif
