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
#include "grove/traverse/instance_walk.h"

namespace grove {

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
          if (filter_ != nullptr) {
            InstanceBatchFilter below(*filter_, instance, walks_, slots);
            ask(object, object_rays, found, below.filter());
          } else {
            ask(object, object_rays, found);
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
          if (filter_ != nullptr) {
            InstanceBatchFilter below(*filter_, instance, walks_, slots);
            ask(object, object_rays, found, below.filter());
          } else {
            ask(object, object_rays, found);
          }
          for (std::size_t k = 0; k < slots.size(); ++k)
            if (found[k] != 0) walks_[slots[k]].hit.primitive = 0;
        },
        [](const InstanceWalk& walk) { return static_cast<bool>(walk.hit); });
  }

 private:
  // More make calls of objects longer, and are more to keep in the caches.
  static constexpr std::size_t kInFlight = 512;
  // Fewer rays at an object are traced one by one: a call that keeps many in flight takes longer to begin than it gains.
  static constexpr std::size_t kFewest = 4;

  // An object's answers to some rays: closest hits, or whether there are any.
  template <typename... Filter>
  static void ask(const Traceable& object, std::span<const Ray> rays, std::span<Hit> found, const Filter&... filter) {
    rays.size() < kFewest ? object.Traceable::closest_hits(rays, found, filter...) : object.closest_hits(rays, found, filter...);
  }
  template <typename... Filter>
  static void ask(const Traceable& object, std::span<const Ray> rays, std::span<std::uint8_t> found, const Filter&... filter) {
    rays.size() < kFewest ? object.Traceable::any_hits(rays, found, filter...) : object.any_hits(rays, found, filter...);
  }

  struct Arrival {
    std::uint32_t instance;
    std::uint32_t slot;
    Ray ray;
  };

  // Where an arrival goes when those at the same instance are side by side.
  struct Place {
    std::uint32_t instance;
    std::uint32_t arrival;
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
    // Puts the next ray that can be traced into a slot; returns whether there was one.
    const auto refill = [&](std::uint32_t slot) {
      for (; next < rays.size(); ++next) {
        if (!rays[next].is_traceable() || bvh_.references.empty()) {
          miss(next);
          continue;
        }
        const auto index = static_cast<std::uint32_t>(next++);
        InstanceWalk::Entry* const stack = stacks.get() + slot * capacity;
        if (slot < walks_.size()) {
          std::construct_at(&walks_[slot], bvh_, rays[index], index, stack);
        } else {
          walks_.emplace_back(bvh_, rays[index], index, stack);
        }
        return true;
      }
      return false;
    };
    for (std::uint32_t slot = 0; slot < in_flight && refill(slot); ++slot) active_.push_back(slot);
    while (!active_.empty()) {
      arrivals_.clear();
      for (const std::uint32_t slot : active_) {
        Arrival& arrival = arrivals_.emplace_back();
        arrival.slot = slot;
        bool is_there = false;
        do {
          InstanceWalk& walk = walks_[slot];
          is_there = !is_over(walk) && walk.advance(bvh_, instances_, arrival.instance, arrival.ray);
          if (!is_there) write(walk);
        } while (!is_there && refill(slot));
        if (!is_there) arrivals_.pop_back();
      }
      gather_arrivals();
      for (std::size_t first = 0, last = 0; first < active_.size(); first = last) {
        while (last < active_.size() && places_[last].instance == places_[first].instance) ++last;
        trace(places_[first].instance, std::span(object_rays_).subspan(first, last - first),
              std::span(active_).subspan(first, last - first));
      }
    }
  }

  // Puts rays and slots of arrivals at the same instance side by side: by counting how many fall into each of a few buckets, which are those of
  // single instances unless there are more instances than arrivals.
  void gather_arrivals() {
    const std::size_t count = arrivals_.size();
    const std::size_t bucket_count = std::bit_ceil(std::min(instances_.size(), 2 * count) + 1);
    const auto bucket_of = [mask = bucket_count - 1](std::uint32_t instance) { return instance & mask; };
    ends_.assign(bucket_count, 0);
    for (const Arrival& arrival : arrivals_) ++ends_[bucket_of(arrival.instance)];
    std::uint32_t sum = 0;
    for (std::uint32_t& end : ends_) end = std::exchange(sum, sum + end);
    places_.resize(count);
    for (std::uint32_t k = 0; k < count; ++k) places_[ends_[bucket_of(arrivals_[k].instance)]++] = {arrivals_[k].instance, k};
    if (bucket_count < instances_.size()) {
      const auto precedes = [&](const Place& a, const Place& b) {
        return std::pair(bucket_of(a.instance), a.instance) < std::pair(bucket_of(b.instance), b.instance);
      };
      for (std::size_t k = 1; k < count; ++k)
        for (std::size_t at = k; at > 0 && precedes(places_[at], places_[at - 1]); --at) std::swap(places_[at], places_[at - 1]);
    }
    active_.resize(count);
    object_rays_.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
      active_[k] = arrivals_[places_[k].arrival].slot;
      object_rays_[k] = arrivals_[places_[k].arrival].ray;
    }
  }

  const WideBvh<8>& bvh_;
  const InstanceSet& instances_;
  const BatchHitFilter* filter_;
  std::vector<InstanceWalk> walks_;  // by slot
  std::vector<std::uint32_t> active_;
  std::vector<Arrival> arrivals_;
  std::vector<std::uint32_t> ends_;  // of buckets
  std::vector<Place> places_;        // of arrivals, those at the same instance side by side
  std::vector<Ray> object_rays_;
  std::vector<Hit> found_hits_;
  std::vector<std::uint8_t> found_any_;
};

}  // namespace grove
