#pragma once

#include "grove/accel/brute.h"
#include "grove/geometry/primitive_test.h"
#include "grove/traverse/traversal_record.h"

namespace grove {

/// Tests every primitive: the reference that all other traversals are checked against. `ray` must be traceable and `hit.t` its t_max.
template <Geometry G, typename C>
void trace_closest(const Brute& /*structure*/, const G& geometry, const Ray& ray, Hit& hit, C& counter) {
  const typename G::PreparedRay prepared = geometry.prepare(ray);
  count_leaf(counter, 0);
  for (std::size_t i = 0; i < geometry.size(); ++i) {
    if (geometry.bounds(i).is_empty()) continue;
    count_test(counter, static_cast<std::uint32_t>(i));
    intersect_primitive(geometry, i, prepared, hit, counter);
  }
}

/// The any-hit form: stops at the first primitive that is hit.
template <Geometry G, typename C>
bool trace_any(const Brute& /*structure*/, const G& geometry, const Ray& ray, C& counter) {
  const typename G::PreparedRay prepared = geometry.prepare(ray);
  count_leaf(counter, 0);
  for (std::size_t i = 0; i < geometry.size(); ++i) {
    if (geometry.bounds(i).is_empty()) continue;
    count_test(counter, static_cast<std::uint32_t>(i));
    if (occluded_primitive(geometry, i, prepared, counter)) return true;
  }
  return false;
}

}  // namespace grove
