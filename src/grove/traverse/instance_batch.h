#pragma once

// Many rays through a wide hierarchy over instances together: each ray walks on until it comes to an instance, then the rays at the same instance are given to
// its object in one call, and so on. So an object that keeps many rays in flight can do so below a top level too. What is found is what one ray
// after another finds, bit for bit: closest hits are the same in whatever order instances are tried.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "grove/accel/wide_bvh.h"
#include "grove/geometry/batch_hit_filter.h"
#include "grove/geometry/instance_set.h"
#include "grove/traverse/wide_traversal.h"

namespace grove {

/// One ray's way through the hierarchy, which it can be made to go on with.
class InstanceWalk {
 public:
  using Child = WideNode<8>::Child;
  using Entry = WaitingChild<Child>;

  /// So many entries a stack needs. Each level leaves at most seven behind; the root, and one more at the last.
  [[nodiscard]] static std::size_t stack_capacity(const WideBvh<8>& bvh) { return 7 * (std::size_t{bvh.depth} + 1) + 2; }

  InstanceWalk(const WideBvh<8>& bvh, const Ray& ray, std::uint32_t index, Entry* stack)
      : prepared_(InstanceSet::prepare(ray)),
        slabs_(SlabRay(ray, bvh.bounds)),
        t_min_(splat(ray.t_min > 0.0F ? ray.t_min : 0.0F)),
        index_(index),
        stack_(stack) {
    hit.t = ray.t_max;
    if (bvh.nodes.empty()) {
      leaf_ = {0, static_cast<std::uint32_t>(bvh.references.size())};
    } else {
      stack_[stack_size_++] = {{0, 0}, -std::numeric_limits<float>::infinity()};
    }
  }

  Hit hit;  ///< the closest so far; its t is how far the ray goes

  [[nodiscard]] std::uint32_t index() const { return index_; }

  /// Goes on to the next instance that may be hit, and writes the ray in its space. Returns false at the end.
  bool advance(const WideBvh<8>& bvh, const InstanceSet& instances, std::uint32_t& instance, Ray& object_ray) {
    for (;;) {
      while (leaf_.count > 0) {
        instance = bvh.references[leaf_.first];
        leaf_ = {leaf_.first + 1, leaf_.count - 1};
        if (instances.enter(instance, prepared_, hit.t, object_ray)) return true;
      }
      Entry top;
      do {
        if (stack_size_ == 0) return false;
        top = stack_[--stack_size_];
        // A tie must still be visited: the instance there may have a lower number.
      } while (top.t > hit.t);
      if (top.child.is_leaf()) {
        leaf_ = top.child;
      } else {
        push_children(bvh.nodes[top.child.node()]);
      }
    }
  }

 private:
  void push_children(const WideNode<8>& node) {
    float entry[8];
    const unsigned met = slabs_.test(node, t_min_, splat(hit.t), entry);
    push_near_to_far(node.child, met, entry, stack_, stack_size_, [](Child /*child*/) {});
  }

  InstanceSet::PreparedRay prepared_;
  WideSlabs<8> slabs_;
  Float4 t_min_;
  std::uint32_t index_;
  Entry* stack_;
  std::uint32_t stack_size_ = 0;
  Child leaf_{0, 0};
};

/// A batch's filter as the object of an instance sees it: rays are numbered as those that have come to the instance, and hits are told with its number.
class InstanceBatchFilter {
 public:
  /// slots[k] is whose walk the object's ray k belongs to.
  InstanceBatchFilter(const BatchHitFilter& outer, std::uint32_t instance, std::span<const InstanceWalk> walks,
                      std::span<const std::uint32_t> slots)
      : outer_(outer), instance_(instance), walks_(walks), slots_(slots) {}

  [[nodiscard]] BatchHitFilter filter() { return {accept, this}; }

 private:
  static bool accept(void* context, std::size_t ray, const Hit& hit) {
    const auto& self = *static_cast<const InstanceBatchFilter*>(context);
    Hit whole = hit;
    whole.instance = self.instance_;
    return self.outer_(self.walks_[self.slots_[ray]].index(), whole);
  }

  BatchHitFilter outer_;
  std::uint32_t instance_;
  std::span<const InstanceWalk> walks_;
  std::span<const std::uint32_t> slots_;
};

/// Traces one batch of up to 2^32 - 1 rays, in one thread. The hierarchy and the instances must outlive it, and the filter, which may be null.
class InstanceBatch {
 public:
  InstanceBatch(const WideBvh<8>& bvh, const InstanceSet& instances, const BatchHitFilter* filter = nullptr)
      : bvh_(bvh), instances_(instances), filter_(filter) {}

  /// hits[i] becomes the closest hit of rays[i]; t is infinite on a miss.
  void trace_closest(std::span<const Ray> rays, std::span<Hit> hits) {
    found_hits_.resize(std::min(kInFlight, rays.size()));
    run(
        rays, [&](InstanceWalk& walk) { finish(walk.hit, hits[walk.index()]); }, [&](std::size_t i) { hits[i] = {}; },
        [&](std::uint32_t instance, std::span<const Ray> object_rays, std::span<const std::uint32_t> slots) {
          const std::span<Hit> found(found_hits_.data(), object_rays.size());
          const Traceable& object = *instances_.instance(instance).object;
          if (filter_ == nullptr) {
            object.closest_hits(object_rays, found);
          } else {
            InstanceBatchFilter below(*filter_, instance, walks_, slots);
            object.closest_hits(object_rays, found, below.filter());
          }
          for (std::size_t k = 0; k < slots.size(); ++k) InstanceSet::take_closer(found[k], instance, walks_[slots[k]].hit);
        },
        [](const InstanceWalk& /*walk*/) { return false; });
  }

  /// results[i] becomes 1 where rays[i] hits anything, else 0.
  void trace_any(std::span<const Ray> rays, std::span<std::uint8_t> results) {
    found_any_.resize(std::min(kInFlight, rays.size()));
    run(
        rays, [&](InstanceWalk& walk) { results[walk.index()] = walk.hit ? 1 : 0; }, [&](std::size_t i) { results[i] = 0; },
        [&](std::uint32_t instance, std::span<const Ray> object_rays, std::span<const std::uint32_t> slots) {
          const std::span<std::uint8_t> found(found_any_.data(), object_rays.size());
          const Traceable& object = *instances_.instance(instance).object;
          if (filter_ == nullptr) {
            object.any_hits(object_rays, found);
          } else {
            InstanceBatchFilter below(*filter_, instance, walks_, slots);
            object.any_hits(object_rays, found, below.filter());
          }
          for (std::size_t k = 0; k < slots.size(); ++k)
            if (found[k] != 0) walks_[slots[k]].hit.primitive = 0;
        },
        [](const InstanceWalk& walk) { return static_cast<bool>(walk.hit); });
  }

 private:
  // More make calls of objects longer, and are more to keep in the caches.
  static constexpr std::size_t kInFlight = 512;

  struct Arrival {
    std::uint32_t instance;
    std::uint32_t slot;
    Ray ray;
  };

  static void finish(const Hit& hit, Hit& result) {
    result = hit;
    if (!hit) result.t = std::numeric_limits<float>::infinity();
  }

  // write(walk) takes the result of a walk that is over, miss(i) that of a ray which cannot be traced; trace(instance, rays, slots) is called for
  // those that have come to an instance; is_over(walk) ends a walk early.
  template <typename Write, typename Miss, typename Trace, typename IsOver>
  void run(std::span<const Ray> rays, const Write& write, const Miss& miss, const Trace& trace, const IsOver& is_over) {
    const std::size_t capacity = InstanceWalk::stack_capacity(bvh_);
    const std::size_t in_flight = std::min(kInFlight, rays.size());
    const auto stacks = std::make_unique_for_overwrite<InstanceWalk::Entry[]>(in_flight * capacity);
    std::size_t next = 0;
    walks_.reserve(in_flight);
    active_.reserve(in_flight);
    arrivals_.reserve(in_flight);
    object_rays_.reserve(in_flight);
    // Puts the next ray that can be traced into a slot; returns whether there was one.
    const auto refill = [&](std::uint32_t slot) {
      for (; next < rays.size(); ++next) {
        if (!rays[next].is_traceable() || bvh_.references.empty()) {
          miss(next);
          continue;
        }
        const InstanceWalk walk(bvh_, rays[next], static_cast<std::uint32_t>(next), stacks.get() + slot * capacity);
        ++next;
        if (slot < walks_.size()) {
          walks_[slot] = walk;
        } else {
          walks_.push_back(walk);
        }
        return true;
      }
      return false;
    };
    for (std::uint32_t slot = 0; slot < in_flight && refill(slot); ++slot) active_.push_back(slot);
    while (!active_.empty()) {
      arrivals_.clear();
      for (const std::uint32_t slot : active_) {
        Arrival arrival{0, slot, {}};
        bool is_there = false;
        do {
          InstanceWalk& walk = walks_[slot];
          is_there = !is_over(walk) && walk.advance(bvh_, instances_, arrival.instance, arrival.ray);
          if (!is_there) write(walk);
        } while (!is_there && refill(slot));
        if (is_there) arrivals_.push_back(arrival);
      }
      std::sort(arrivals_.begin(), arrivals_.end(),
                [](const Arrival& a, const Arrival& b) { return std::pair(a.instance, a.slot) < std::pair(b.instance, b.slot); });
      active_.clear();
      object_rays_.clear();
      for (const Arrival& arrival : arrivals_) {
        active_.push_back(arrival.slot);
        object_rays_.push_back(arrival.ray);
      }
      for (std::size_t first = 0, last = 0; first < arrivals_.size(); first = last) {
        while (last < arrivals_.size() && arrivals_[last].instance == arrivals_[first].instance) ++last;
        trace(arrivals_[first].instance, std::span(object_rays_).subspan(first, last - first),
              std::span(active_).subspan(first, last - first));
      }
    }
  }

  const WideBvh<8>& bvh_;
  const InstanceSet& instances_;
  const BatchHitFilter* filter_;
  std::vector<InstanceWalk> walks_;  // by slot
  std::vector<std::uint32_t> active_;
  std::vector<Arrival> arrivals_;
  std::vector<Ray> object_rays_;
  std::vector<Hit> found_hits_;
  std::vector<std::uint8_t> found_any_;
};

}  // namespace grove
