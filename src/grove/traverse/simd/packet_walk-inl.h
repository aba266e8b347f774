// Some dozens of rays whose directions have the same signs go through the hierarchy side by side. A node is tested for all of them at once, by intervals that
// hold their slopes and origins; what is left is entered with the rays that meet its box, each tested by itself, so that no more is visited than by the
// same rays alone but for the order. Where few rays enter, the child is handed over to them: each goes on there alone, among the rays in flight. Intervals are
// after Boulos, Wald, Shirley, "Geometric and Arithmetic Culling Methods for Entire Ray Packets" (2006), going on alone after Benthin, Wald, Woop, Ernst, Mark,
// "Combining Single and Packet-Ray Tracing for Arbitrary Ray Distributions on the Intel MIC Architecture" (2012). Included once for each instruction set.

#if defined(GROVE_PACKET_WALK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_PACKET_WALK_INL_H
#undef GROVE_PACKET_WALK_INL_H
#else
#define GROVE_PACKET_WALK_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "grove/accel/fast_bvh.h"
#include "grove/traverse/simd/batch_ray.h"
#include "grove/traverse/simd/batch_slot.h"
#include "grove/traverse/simd/compaction-inl.h"
#include "grove/traverse/simd/node_step-inl.h"
#include "grove/traverse/simd/packet_rays-inl.h"
#include "grove/traverse/simd/ray_group-inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// The planes of a row of boxes, in floats. On a grid they round once, by 2^-24 of what they are, which the ray's own pad allows for as in node_step-inl.h.
template <typename D>
HWY_INLINE hn::Vec<D> row_of_planes(D d, const FastNode& node, int /*axis*/, std::uint32_t row, std::size_t first) {
  return hn::LoadU(d, &node.bounds.planes[0][0][0] + row + first);
}
template <typename D>
HWY_INLINE hn::Vec<D> row_of_planes(D d, const CompressedNode& node, int axis, std::uint32_t row, std::size_t first) {
  const hn::Rebind<std::uint8_t, D> d8;
  const hn::RebindToSigned<D> di;
  const auto steps = hn::ConvertTo(d, hn::PromoteTo(di, hn::LoadU(d8, &node.steps[0][0][0] + row + first)));
  return hn::MulAdd(steps, hn::Set(d, node.scale_along(axis)), hn::Set(d, node.origin[axis]));
}

// One of them.
HWY_INLINE float plane_of(const FastNode& node, int /*axis*/, std::uint32_t row, std::uint32_t place) {
  return (&node.bounds.planes[0][0][0])[row + place];
}
HWY_INLINE float plane_of(const CompressedNode& node, int axis, std::uint32_t row, std::uint32_t place) {
  return static_cast<float>((&node.steps[0][0][0])[row + place]) * node.scale_along(axis) + node.origin[axis];
}

// Up to kRays rays; a bit stands for each. kAny: any hit instead of the closest.
template <typename Bvh, bool kAny>
class PacketWalk {
  using Node = typename Bvh::Node;

 public:
  static constexpr std::size_t kRays = PacketRays::kCount;
  using Rays = PacketRays::Set;
  // Children that no more rays enter are handed over.
  static constexpr int kFew = 2;
  // Where less than a part of the rays enters what is tested, on average and after so many tests, each does better alone.
  static constexpr std::uint32_t kLeastPart = 5;
  static constexpr std::uint32_t kTrial = 16;

  explicit PacketWalk(const Bvh& bvh) : bounds_(bvh.bounds), units_(bvh.units()) {}

  // Takes rays of a group that are a packet, as PacketRays does; `rays` are these.
  HWY_INLINE void take(const RayGroup<kRays>& group, std::size_t first, std::size_t count, const Ray* rays) {
    rays_.take(group, first, count, rays);
    bound(rays[0].origin);
  }
  [[nodiscard]] PacketRays& rays() { return rays_; }

  // Visits leaves near to far, as far as near and far are the same for the rays, or for any hit those in large boxes first: test_leaf(word, rays) tests the block for some,
  // shortens those that are hit and returns those that look for nothing more. hand_over(word, rays, nears) has the child visited later by these rays, from the distances
  // nears[ray], before what was handed over earlier, and returns whether it could; else the walk enters the child. Returns the rays
  // that look for nothing more. The hierarchy must not be empty.
  template <typename TestLeaf, typename HandOver>
  HWY_INLINE Rays run(const TestLeaf& test_leaf, const HandOver& hand_over) {
    const Rays all = ~Rays{0} >> (kRays - rays_.count);
    Rays left = all;
    stack_size_ = 0;
    tested_ = 0;
    entered_ = 0;
    push_children(0, left);
    while (stack_size_ != 0) {
      const Entry entry = stack_[--stack_size_];
      const Rays rays = entering(entry, entry.rays & left);
      ++tested_;
      entered_ += static_cast<std::uint32_t>(std::popcount(rays));
      if (rays == 0) continue;
      if ((std::popcount(rays) <= kFew || !is_worth_it()) && hand_over(entry.word, rays, near_)) continue;
      if (entry.word >> 31 == 0) {
        push_children(entry.word, rays);
        continue;
      }
      left &= ~test_leaf(entry.word, rays);
      if (left == 0) break;
      farthest_ = largest(rays_.t);
    }
    return all & ~left;
  }

  // Whether many rays have entered what was tested.
  [[nodiscard]] bool is_worth_it() const { return tested_ < kTrial || kLeastPart * entered_ >= rays_.count * tested_; }

 private:
  struct Entry {
    const Node* parent;
    std::uint32_t place;
    std::uint32_t word;
    Rays rays;
  };

  HWY_INLINE float least(const float* lanes) const {
    const hn::CappedTag<float, 16> d;
    auto v = hn::LoadU(d, lanes);
    for (std::size_t i = hn::MaxLanes(d); i < rays_.count; i += hn::MaxLanes(d)) v = hn::Min(v, hn::LoadU(d, lanes + i));
    return hn::GetLane(hn::MinOfLanes(d, v));
  }
  HWY_INLINE float largest(const float* lanes) const {
    const hn::CappedTag<float, 16> d;
    auto v = hn::LoadU(d, lanes);
    for (std::size_t i = hn::MaxLanes(d); i < rays_.count; i += hn::MaxLanes(d)) v = hn::Max(v, hn::LoadU(d, lanes + i));
    return hn::GetLane(hn::MaxOfLanes(d, v));
  }

  // A plane at p is met by a ray at  p * inverse + offset  =  (p - c) * inverse + (c * inverse + offset)  for any c; at c near all origins the second
  // part is small. So with intervals of inverses and of second parts, all rays meet it within an interval.
  HWY_INLINE void bound(const Vec3& c) {
    for (int axis = 0; axis < 3; ++axis) {
      center_[axis] = c[axis];
      inverse_bounds_[axis][0] = least(rays_.inverse(axis));
      inverse_bounds_[axis][1] = largest(rays_.inverse(axis));
      HWY_ALIGN float near_rest[kRays];
      HWY_ALIGN float far_rest[kRays];
      const hn::CappedTag<float, 16> d;
      for (std::size_t i = 0; i < rays_.count; i += hn::MaxLanes(d)) {
        const auto inverse = hn::LoadU(d, rays_.inverse(axis) + i);
        hn::Store(hn::MulAdd(hn::Set(d, c[axis]), inverse, hn::LoadU(d, rays_.near_offset(axis) + i)), d, near_rest + i);
        hn::Store(hn::MulAdd(hn::Set(d, c[axis]), inverse, hn::LoadU(d, rays_.far_offset(axis) + i)), d, far_rest + i);
      }
      // Products and sums round four times by 2^-24 of what they are, which is at most the way to the farthest plane, and c.
      const float reach = std::max(std::abs(bounds_.lower[axis] - c[axis]), std::abs(bounds_.upper[axis] - c[axis])) + std::abs(c[axis]);
      const float steepest = std::max(std::abs(inverse_bounds_[axis][0]), std::abs(inverse_bounds_[axis][1]));
      const float pad = 0x1p-20F * reach * steepest;
      near_rest_[axis] = least(near_rest) - pad;
      far_rest_[axis] = largest(far_rest) + pad;
    }
    nearest_ = least(rays_.t_min());
    farthest_ = largest(rays_.t);
  }

  // Which children's boxes the intervals meet.
  [[nodiscard]] HWY_INLINE std::uint32_t met_by_any(const Node& node) const {
    const hn::CappedTag<float, FastNode::kWidth> d;
    std::uint32_t met = 0;
    for (std::size_t first = 0; first < FastNode::kWidth; first += hn::MaxLanes(d)) {
      auto near = hn::Set(d, nearest_);
      auto far = hn::Set(d, farthest_);
      for (int axis = 0; axis < 3; ++axis) {
        const auto center = hn::Set(d, center_[axis]);
        const auto low = hn::Set(d, inverse_bounds_[axis][0]);
        const auto high = hn::Set(d, inverse_bounds_[axis][1]);
        const auto to_near = hn::Sub(row_of_planes(d, node, axis, rays_.rows.near[axis], first), center);
        const auto to_far = hn::Sub(row_of_planes(d, node, axis, rays_.rows.far(axis), first), center);
        near = hn::Max(near, hn::Add(hn::Min(hn::Mul(to_near, low), hn::Mul(to_near, high)), hn::Set(d, near_rest_[axis])));
        far = hn::Min(far, hn::Add(hn::Max(hn::Mul(to_far, low), hn::Mul(to_far, high)), hn::Set(d, far_rest_[axis])));
      }
      met |= bits_of(d, hn::Le(near, far)) << first;
    }
    return used_places(node) & met;
  }

  HWY_INLINE void push_children(std::uint32_t word, Rays rays) {
    const Node& node = place_of<Node>(units_, word);
    const std::uint32_t met = met_by_any(node);
    const std::uint32_t order = pushing_order<kAny>(node, rays_.rows.octant);
    for (int k = 0; k < FastNode::kWidth; ++k) {
      const std::uint32_t place = order >> (3 * k) & 7U;
      const auto child = std::bit_cast<std::uint32_t>(node.child[place]);
      stack_[stack_size_] = {&node, place, child, rays};
      stack_size_ += met >> place & 1U;
    }
    for (std::uint32_t left = met; left != 0; left &= left - 1) {
      const auto child = std::bit_cast<std::uint32_t>(node.child[std::countr_zero(left)]);
      const char* const line = &place_of<char>(units_, child);
      for (std::size_t offset = 0; offset < sizeof(Node); offset += 64) __builtin_prefetch(line + offset);
    }
  }

  // Which of some rays meet the box of a child, and where they enter it.
  HWY_INLINE Rays entering(const Entry& entry, Rays some) {
    const hn::CappedTag<float, 16> d;
    Rays met = 0;
    float planes[3][2];
    for (int axis = 0; axis < 3; ++axis) {
      planes[axis][0] = plane_of(*entry.parent, axis, rays_.rows.near[axis], entry.place);
      planes[axis][1] = plane_of(*entry.parent, axis, rays_.rows.far(axis), entry.place);
    }
    for (std::size_t i = 0; i < rays_.count; i += hn::MaxLanes(d)) {
      if ((some >> i & ((Rays{1} << hn::MaxLanes(d)) - 1)) == 0) continue;
      auto near = hn::LoadU(d, rays_.t_min() + i);
      auto far = hn::Load(d, rays_.t + i);
      for (int axis = 0; axis < 3; ++axis) {
        const auto inverse = hn::LoadU(d, rays_.inverse(axis) + i);
        near = hn::Max(near, hn::MulAdd(hn::Set(d, planes[axis][0]), inverse, hn::LoadU(d, rays_.near_offset(axis) + i)));
        far = hn::Min(far, hn::MulAdd(hn::Set(d, planes[axis][1]), inverse, hn::LoadU(d, rays_.far_offset(axis) + i)));
      }
      hn::Store(near, d, near_ + i);
      met |= Rays{bits_of(d, hn::Le(near, far))} << i;
    }
    return met & some;
  }

  const Box bounds_;
  const FastUnit* const units_;
  PacketRays rays_;
  HWY_ALIGN float near_[kRays];
  // Of all rays.
  float center_[3];
  float inverse_bounds_[3][2];
  float near_rest_[3];
  float far_rest_[3];
  float nearest_;
  float farthest_;
  std::uint32_t tested_ = 0;
  std::uint32_t entered_ = 0;
  std::size_t stack_size_ = 0;
  // Each level leaves at most seven behind.
  Entry stack_[(FastNode::kWidth - 1) * (Bvh2::kMaxDepth + 1) + FastNode::kWidth];
};

}  // namespace HWY_NAMESPACE
}  // namespace grove
HWY_AFTER_NAMESPACE();

#endif
