// The kernel of fast_single.h. Included once for each instruction set.

#if defined(GROVE_SINGLE_RAY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_SINGLE_RAY_INL_H
#undef GROVE_SINGLE_RAY_INL_H
#else
#define GROVE_SINGLE_RAY_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>

#include "grove/geometry/hit_filter.h"
#include "grove/traverse/fast_traversal.h"
#include "grove/traverse/simd/batch_slot.h"
#include "grove/traverse/simd/beside.h"
#include "grove/traverse/simd/block_hits-inl.h"
#include "grove/traverse/simd/block_test-inl.h"
#include "grove/traverse/simd/node_step-inl.h"
#include "grove/traverse/simd/ray_setup-inl.h"
#include "grove/traverse/simd/triangle_test.h"

HWY_BEFORE_NAMESPACE();
namespace grove {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// One ray with nothing else in flight. kAny: any hit instead of the closest.
template <typename Bvh, TriangleTest kTest, bool kAny, Beside kBeside>
class SingleRay {
  using Node = typename Bvh::Node;
  using Block = typename Bvh::Block;
  using D = hn::CappedTag<float, FastNode::kWidth>;
  static constexpr bool kCounts = kBeside == Beside::counting;
  static constexpr bool kFilters = kBeside == Beside::filtering;

 public:
  // What is counted into, or the filter that is asked.
  using Companion = std::conditional_t<kFilters, const HitFilter, TraversalCounts>;

  // `hit.t` is t_max; a hit is written there, for kAny without a filter its primitive as 0. Returns false where the ray or the hierarchy is none for this kernel.
  HWY_INLINE static bool trace(const FastScene<Bvh>& scene, const Ray& ray, Hit& hit, Companion* companion) {
    const Bvh& bvh = scene.bvh;
    if (bvh.depth > kMostDepth) return false;
    const RaySetup<4> setup(bvh.bounds);
    RaySetup<4>::One one;
    if (!setup.prepare(ray, one)) return false;
    SingleRay single(scene, hit, companion);
    one.copy(single.memory_.slot.ray);
    single.run();
    return true;
  }

 private:
  static constexpr std::size_t kMostDepth = 40;
  static constexpr std::size_t kCapacity = ((FastNode::kWidth - 1) * (kMostDepth + 1) + 1 + kSlack + 15) / 16 * 16;

  // A slot with its stack behind it, on the stack of the program.
  struct Memory {
    BatchSlot slot;
    float stack_t[kCapacity];
    std::uint32_t stack_child[kCapacity];
  };
  static_assert(offsetof(Memory, stack_t) == sizeof(BatchSlot));

  HWY_INLINE SingleRay(const FastScene<Bvh>& scene, Hit& hit, Companion* companion)
      : units_(scene.bvh.units()), vertices_(scene.vertices), hit_(hit), companion_(companion) {
    memory_.slot.t = hit.t;
    memory_.slot.stack_size = 1;
    memory_.stack_t[0] = -std::numeric_limits<float>::infinity();
    memory_.stack_child[0] = kDone;
  }

  HWY_INLINE void run() {
    BatchSlot& slot = memory_.slot;
    const SlabRay<D> ray = slab_ray(D(), slot.ray);
    const PlaneRows rows = slot.ray.rows;
    std::uint32_t word = 0;
    while (true) {
      if (word >> 31 == 0) {
        if constexpr (kCounts) ++companion_->nodes_visited;
        if (step(place_of<Node>(units_, word), ray, rows, word)) continue;
      } else if (word == kDone || test(gathered(place_of<Block>(units_, word), vertices_))) {
        return;
      }
      word = memory_.stack_child[--slot.stack_size];
      if constexpr (!kAny) {
        // A tie must still be visited: the primitive there may have a lower id. The entry at the bottom is nearer than any hit.
        while (memory_.stack_t[slot.stack_size] > slot.t) word = memory_.stack_child[--slot.stack_size];
      }
    }
  }

  // Goes to the nearest child that is met, or for any hit to the largest, and pushes the others; returns false where none is. Mostly it is one or two: then the way to the next
  // node is short, and the branches tell the processor where it leads before the slabs are done.
  HWY_INLINE bool step(const Node& node, const SlabRay<D>& ray, const PlaneRows& rows, std::uint32_t& word) {
    BatchSlot& slot = memory_.slot;
    HWY_ALIGN float near_of[FastNode::kWidth];
    const D d;
    std::uint32_t met = 0;
    for (std::size_t first = 0; first < FastNode::kWidth; first += hn::MaxLanes(d)) {
      const auto [near, far] = slabs(d, node, ray, rows, hn::Set(d, slot.t), first);
      if constexpr (!kAny) hn::Store(near, d, near_of + first);
      met |= bits_of(d, hn::Le(near, far)) << first;
    }
    met = used_places(node) & met;
    if (met == 0) return false;
    std::uint32_t place = static_cast<std::uint32_t>(std::countr_zero(met));
    met &= met - 1;
    if (met == 0) {
      word = std::bit_cast<std::uint32_t>(node.child[place]);
      return true;
    }
    if ((met & (met - 1)) == 0) {
      auto other = static_cast<std::uint32_t>(std::countr_zero(met));
      if constexpr (!kAny) {
        if (near_of[other] < near_of[place]) std::swap(place, other);
        memory_.stack_t[slot.stack_size] = near_of[other];
      } else {
        std::swap(place, other);
      }
      memory_.stack_child[slot.stack_size++] = std::bit_cast<std::uint32_t>(node.child[other]);
      prefetch(std::bit_cast<std::uint32_t>(node.child[other]));
      word = std::bit_cast<std::uint32_t>(node.child[place]);
    } else {
      for (std::uint32_t left = met; left != 0; left &= left - 1)
        prefetch(std::bit_cast<std::uint32_t>(node.child[std::countr_zero(left)]));
      push_all(node, near_of, met | 1U << place);
      word = memory_.stack_child[--slot.stack_size];
    }
    if constexpr (kCounts) companion_->stack_depth = std::max(companion_->stack_depth, slot.stack_size);
    return true;
  }

  HWY_INLINE void prefetch(std::uint32_t word) const {
    const char* const line = &place_of<char>(units_, word);
    for (std::size_t offset = 0; offset < sizeof(Node); offset += 64) __builtin_prefetch(line + offset);
  }

  // In the node's order for the ray, the nearest last; or as they are, the largest last.
  HWY_INLINE void push_all(const Node& node, const float* near_of, std::uint32_t met) {
    if constexpr (kAny) {
      for (; met != 0; met &= met - 1)
        memory_.stack_child[memory_.slot.stack_size++] = std::bit_cast<std::uint32_t>(node.child[std::countr_zero(met)]);
    } else {
      push_one_by_one<false>(node, memory_.slot, kCapacity, near_of, met);
    }
  }

  // Returns whether that is all: a hit, where any will do.
  HWY_INLINE bool test(const TriangleBlock& block) {
    BatchSlot& slot = memory_.slot;
    if constexpr (kCounts) {
      companion_->primitives_tested += block.count();
      ++companion_->leaves_entered;
    }
    if constexpr (kTest == TriangleTest::fast) {
      FourHits hits;
      test_block(slot.ray, slot.t, block, hits);
      if (hits.places == 0) return false;
      if constexpr (kAny && !kFilters) {
        hit_.primitive = 0;
        return true;
      }
      if constexpr (kFilters) {
        take_closest(hits, block, hit_, *companion_);
        if (kAny && hit_) return true;
      } else {
        take_closest(hits, block, hit_, AcceptsAll());
      }
      slot.t = hit_.t;
      return false;
    }
    const BlockFilter filter = filter_block < kAny && !kFilters > (slot.ray, slot.t, block);
    if constexpr (kAny && !kFilters) {
      if (filter.certain != 0) {
        hit_.primitive = 0;
        return true;
      }
    }
    return filter.possible != 0 && settle(block, filter.possible);
  }

  // Measures the triangles of a block that may be hit, all at once. Returns whether that is all.
  HWY_INLINE bool settle(const TriangleBlock& block, std::uint32_t possible) {
    BatchSlot& slot = memory_.slot;
    MeasuredBlock measured;
    measure_block(slot.ray, block, measured);
    for (; possible != 0; possible &= possible - 1) {
      const auto place = static_cast<std::uint32_t>(std::countr_zero(possible));
      const bool is_known = (measured.known >> place & 1U) != 0;
      if (!(is_known ? take_measured(measured, block, place) : take_alone(block, place))) continue;
      if constexpr (kAny) return true;
    }
    slot.t = hit_.t;
    return false;
  }

  HWY_INLINE bool take_measured(const MeasuredBlock& measured, const TriangleBlock& block, std::uint32_t place) {
    Hit candidate;
    candidate.t = measured.t[place];
    if (!(candidate.t >= memory_.slot.ray.t_min)) return false;
    if constexpr (kAny && !kFilters) {
      if (!(candidate.t <= memory_.slot.t && candidate.t < std::numeric_limits<float>::infinity())) return false;
      hit_.primitive = 0;
      return true;
    }
    candidate.primitive = block.primitive[place];
    if (!is_closer(candidate.t, candidate.primitive, hit_)) return false;
    const float sum = measured.weights[0][place] + measured.weights[1][place] + measured.weights[2][place];
    candidate.u = measured.weights[1][place] / sum;
    candidate.v = measured.weights[2][place] / sum;
    if constexpr (kFilters) {
      if (!(*companion_)(candidate)) return false;
    }
    hit_ = candidate;
    return true;
  }

  HWY_NOINLINE bool take_alone(const TriangleBlock& block, std::uint32_t place) {
    const WatertightRay ray = memory_.slot.ray.triangle_ray();
    const SingleTriangle triangle = triangle_in(block, place);
    if constexpr (kAny && !kFilters) {
      if (!occluded_watertight(ray, triangle.corners)) return false;
      hit_.primitive = 0;
      return true;
    }
    Hit candidate = hit_;
    if (!intersect_watertight(ray, triangle.corners, &block.primitive[place], candidate)) return false;
    if constexpr (kFilters) {
      if (!(*companion_)(candidate)) return false;
    }
    hit_ = candidate;
    return true;
  }

  const FastUnit* const units_;
  const Vec3* const vertices_;
  Hit& hit_;
  Companion* const companion_;
  Memory memory_;
};

}  // namespace HWY_NAMESPACE
}  // namespace grove
HWY_AFTER_NAMESPACE();

#endif
