#pragma once

// Rays past primitives that do not count: a traversal asks about each hit that it would take, and goes on as though a refused one were not there. That
// finds what is behind cut-out leaves in one walk, where starting another ray at each would walk down again and have to step off the surface.

#include <concepts>

#include "grove/geometry/geometry_concept.h"
#include "grove/geometry/hit.h"

namespace grove {

/// Which hits of one ray count. `accept` is given a whole hit (t, u, v, primitive, geometry, and instance below a top level), and must answer by
/// that alone: it is asked in an order, and as often, as the structure likes. Then every structure finds the same, bit for bit. It must not
/// throw. Refers to `context`, which may be anything; not for several rays at once unless `accept` allows it.
struct HitFilter {
  bool (*accept)(void* context, const Hit& hit) = nullptr;
  void* context = nullptr;

  [[nodiscard]] bool operator()(const Hit& hit) const { return accept(context, hit); }
};

/// A counter that counts nothing and has a say in which hits count. Traversals for other counters compile without it.
template <typename G>
class FilteringCounter : public NoCounter {
 public:
  FilteringCounter(const HitFilter& filter, const G& geometry) : filter_(&filter), geometry_(&geometry) {}

  /// Whether a hit counts that names its primitive by the number in the whole geometry.
  [[nodiscard]] bool accepts(Hit hit) const {
    geometry_->locate(hit);
    return (*filter_)(hit);
  }
  /// For the levels below.
  [[nodiscard]] const HitFilter& filter() const { return *filter_; }

 private:
  const HitFilter* filter_;
  const G* geometry_;
};

template <typename C>
concept FiltersHits = requires(const C& counter, const Hit& hit) {
  { counter.accepts(hit) } -> std::same_as<bool>;
};

/// Lets `test(hit)`, which replaces a hit by a closer one and says so, do its work, and takes it back when the counter's filter refuses.
template <typename C, typename Test>
[[gnu::always_inline]] inline bool take_if_accepted(const C& counter, Hit& hit, const Test& test) {
  if constexpr (FiltersHits<C>) {
    Hit candidate = hit;
    if (!test(candidate) || !counter.accepts(candidate)) return false;
    hit = candidate;
    return true;
  } else {
    return test(hit);
  }
}

}  // namespace grove
