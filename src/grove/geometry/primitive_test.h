#pragma once

// The test of one primitive of any geometry on behalf of a traversal, with whatever filter its counter has.

#include <cmath>
#include <concepts>
#include <limits>

#include "grove/geometry/geometry_concept.h"
#include "grove/geometry/hit_filter.h"
#include "grove/geometry/instance_set.h"

namespace grove {

namespace detail {

template <typename Prepared>
[[nodiscard]] Ray& ray_of(Prepared& prepared) {
  if constexpr (std::same_as<Prepared, Ray>) {
    return prepared;
  } else {
    return prepared.ray;
  }
}

}  // namespace detail

/// G::intersect, or what it comes to without the hits that are refused. A primitive that a ray may meet more than once, as a sphere, is asked again
/// behind a refused hit.
template <Geometry G, typename C>
bool intersect_primitive(const G& geometry, std::size_t i, const typename G::PreparedRay& ray, Hit& hit, C& counter) {
  // Instances hand the filter down instead.
  if constexpr (!FiltersHits<C> || std::same_as<G, InstanceSet>) {
    return geometry.intersect(i, ray, hit, counter);
  } else {
    Hit candidate = hit;
    if (!geometry.intersect(i, ray, candidate, counter)) return false;
    if (!counter.accepts(candidate)) {
      typename G::PreparedRay rest = ray;
      do {
        detail::ray_of(rest).t_min = std::nextafter(candidate.t, std::numeric_limits<float>::infinity());
        candidate = hit;
        if (!geometry.intersect(i, rest, candidate, counter) || candidate.t < detail::ray_of(rest).t_min) return false;
      } while (!counter.accepts(candidate));
    }
    hit = candidate;
    return true;
  }
}

/// G::occluded, in the same way.
template <Geometry G, typename C>
bool occluded_primitive(const G& geometry, std::size_t i, const typename G::PreparedRay& ray, C& counter) {
  if constexpr (!FiltersHits<C> || std::same_as<G, InstanceSet>) {
    return geometry.occluded(i, ray, counter);
  } else {
    typename G::PreparedRay whole = ray;
    Hit hit;
    hit.t = detail::ray_of(whole).t_max;
    return intersect_primitive(geometry, i, ray, hit, counter);
  }
}

}  // namespace grove
