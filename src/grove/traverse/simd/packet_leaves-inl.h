// Tests of triangles for the rays of a packet: one triangle, and as many rays as a register has lanes. Hits are the same as those of the rays alone, bit for
// bit. Included once for each instruction set.

#if defined(GROVE_PACKET_LEAVES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_PACKET_LEAVES_INL_H
#undef GROVE_PACKET_LEAVES_INL_H
#else
#define GROVE_PACKET_LEAVES_INL_H
#endif

#include <hwy/highway.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

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

namespace hn = hwy::HWY_NAMESPACE;

// kAny: any hit instead of the closest.
template <typename Bvh, TriangleTest kTest, bool kAny, Beside kBeside>
class PacketLeaves {
  using Block = typename Bvh::Block;
  using Rays = PacketRays::Set;
  static constexpr bool kFilters = kBeside == Beside::filtering;
  // Any hit will do, wherever it is.
  static constexpr bool kAnywhere = kAny && !kFilters;

 public:
  PacketLeaves(const BatchQuery<Bvh>& query, PacketRays& packet) : query_(query), packet_(packet) {}

  // Tests a block for some of the rays, of which number 0 is `first` in the batch, and takes their hits. Returns those that look for nothing more.
  HWY_INLINE Rays test(std::uint32_t word, Rays rays, std::size_t first) {
    const TriangleBlock& block = gathered(place_of<Block>(query_.scene.bvh.units(), word), query_.scene.vertices);
    first_ = first;
    Rays finished = 0;
    const std::uint32_t count = block.count();
    for (std::uint32_t place = 0; place < count && rays != 0; ++place) {
      Rays hit = 0;
      if constexpr (kTest == TriangleTest::watertight) {
        const PacketRays::Pairs pairs = packet_.template filter<kAnywhere>(block, place, rays);
        hit = pairs.certain | measure_rays(block, place, pairs.possible & ~pairs.certain);
      } else {
        hit = test_rays(block, place, rays);
      }
      if constexpr (kAny) {
        finished |= hit;
        rays &= ~hit;
      }
    }
    return finished;
  }

 private:
  template <typename F>
  HWY_INLINE void set_corners(const TriangleBlock& block, std::uint32_t place, RayTrianglePairs<F>& pairs) const {
    const hn::DFromV<F> d;
    const std::uint32_t axes[3] = {packet_.axes.kx, packet_.axes.ky, packet_.axes.kz};
    for (int axis = 0; axis < 3; ++axis)
      for (int i = 0; i < 3; ++i) pairs.corner[axis][i] = hn::Set(d, block.corners[axes[axis]][i][place]);
  }
  template <typename F>
  HWY_INLINE void set_rays(std::size_t lane, RayTrianglePairs<F>& pairs) const {
    const hn::DFromV<F> d;
    for (int axis = 0; axis < 3; ++axis) {
      pairs.minus_origin[axis] = hn::LoadU(d, packet_.minus_origin_k(axis) + lane);
      pairs.direction[axis] = hn::LoadU(d, packet_.direction_k(axis) + lane);
    }
    pairs.shear[0] = hn::LoadU(d, packet_.shear_x() + lane);
    pairs.shear[1] = hn::LoadU(d, packet_.shear_y() + lane);
  }

  // The watertight test for rays that may hit a triangle. Returns those whose hits are new.
  HWY_INLINE Rays measure_rays(const TriangleBlock& block, std::uint32_t place, Rays rays) {
    const hn::CappedTag<double, 8> dd;
    const hn::Rebind<float, decltype(dd)> df;
    RayTrianglePairs<hn::Vec<decltype(df)>> pairs;
    set_corners(block, place, pairs);
    Rays hit = 0;
    Rays unknown = 0;
    for (std::size_t lane = 0; lane < packet_.count; lane += hn::MaxLanes(dd)) {
      const Rays some = rays & group<hn::MaxLanes(dd)>(lane);
      if (some == 0) continue;
      set_rays(lane, pairs);
      const auto hits = measure(dd, pairs);
      const Rays known = Rays{hits.known} << lane;
      unknown |= some & ~known;
      const auto sum = hn::Add(hn::Add(hits.weights[0], hits.weights[1]), hits.weights[2]);
      hit |= take(df, lane, some & known, hits.t, hn::Div(hits.weights[1], sum), hn::Div(hits.weights[2], sum), block.primitive[place]);
    }
    for (Rays left = unknown; left != 0; left &= left - 1) {
      const auto ray = static_cast<std::uint32_t>(std::countr_zero(left));
      if (test_alone(ray, block, place)) hit |= Rays{1} << ray;
    }
    return hit;
  }

  // The test in floats alone.
  HWY_INLINE Rays test_rays(const TriangleBlock& block, std::uint32_t place, Rays rays) {
    const PacketRays::D d;
    RayTrianglePairs<hn::Vec<PacketRays::D>> pairs;
    set_corners(block, place, pairs);
    Rays hit = 0;
    for (std::size_t lane = 0; lane < packet_.count; lane += hn::MaxLanes(d)) {
      const Rays some = rays & group<hn::MaxLanes(d)>(lane);
      if (some == 0) continue;
      set_rays(lane, pairs);
      const auto hits = test_pairs(d, pairs, hn::LoadU(d, packet_.t_min() + lane), hn::Load(d, packet_.t + lane));
      const Rays inside = Rays{bits_of(d, hits.mask)} << lane;
      hit |= take(d, lane, some & inside, hits.t, hits.u, hits.v, block.primitive[place]);
    }
    return hit;
  }

  template <std::size_t kLanes>
  static Rays group(std::size_t lane) {
    return static_cast<Rays>(((std::uint64_t{1} << kLanes) - 1) << lane);
  }

  // Takes hits of some of the rays from number `lane` on where they are closer than what these have hit; returns those.
  template <typename D, typename V = hn::Vec<D>>
  HWY_INLINE Rays take(D d, std::size_t lane, Rays some, V t, V u, V v, std::uint32_t primitive) {
    const hn::RebindToUnsigned<D> du;
    const V kept_t = hn::LoadU(d, packet_.t + lane);
    const auto kept = hn::LoadU(du, packet_.primitive + lane);
    const auto number = hn::Set(du, primitive);
    const auto in_range =
        hn::And(hn::Ge(t, hn::LoadU(d, packet_.t_min() + lane)), hn::Lt(t, hn::Set(d, std::numeric_limits<float>::infinity())));
    if constexpr (kAnywhere) return some & Rays{bits_of(d, hn::And(in_range, hn::Le(t, kept_t)))} << lane;
    const auto is_closer = hn::Or(hn::Lt(t, kept_t), hn::And(hn::Eq(t, kept_t), hn::RebindMask(d, hn::Lt(number, kept))));
    Rays taken = some & Rays{bits_of(d, hn::And(in_range, is_closer))} << lane;
    if constexpr (kFilters) {
      HWY_ALIGN float lanes[3][hn::MaxLanes(d)];
      hn::Store(t, d, lanes[0]);
      hn::Store(u, d, lanes[1]);
      hn::Store(v, d, lanes[2]);
      for (Rays left = std::exchange(taken, 0); left != 0; left &= left - 1) {
        const auto ray = static_cast<std::uint32_t>(std::countr_zero(left));
        Hit hit;
        hit.t = lanes[0][ray - lane];
        hit.u = lanes[1][ray - lane];
        hit.v = lanes[2][ray - lane];
        hit.primitive = primitive;
        if (!(*query_.filter)(first_ + ray, hit)) continue;
        packet_.set_hit(ray, hit);
        taken |= Rays{1} << ray;
      }
      return taken;
    }
    if (taken == 0) return 0;
    const auto mask = mask_of(d, static_cast<std::uint32_t>(taken >> lane));
    hn::StoreU(hn::IfThenElse(mask, t, kept_t), d, packet_.t + lane);
    hn::StoreU(hn::IfThenElse(mask, u, hn::LoadU(d, packet_.u + lane)), d, packet_.u + lane);
    hn::StoreU(hn::IfThenElse(mask, v, hn::LoadU(d, packet_.v + lane)), d, packet_.v + lane);
    hn::StoreU(hn::IfThenElse(hn::RebindMask(du, mask), number, kept), du, packet_.primitive + lane);
    return taken;
  }

  HWY_NOINLINE bool test_alone(std::uint32_t number, const TriangleBlock& block, std::uint32_t place) {
    const WatertightRay ray(query_.rays[first_ + number]);
    const SingleTriangle triangle = triangle_in(block, place);
    if constexpr (kAnywhere) return occluded_watertight(ray, triangle.corners);
    Hit hit = packet_.hit(number);
    if (!intersect_watertight(ray, triangle.corners, &block.primitive[place], hit)) return false;
    if constexpr (kFilters) {
      if (!(*query_.filter)(first_ + number, hit)) return false;
    }
    packet_.set_hit(number, hit);
    return true;
  }

  const BatchQuery<Bvh>& query_;
  PacketRays& packet_;
  std::size_t first_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace grove
HWY_AFTER_NAMESPACE();

#endif
