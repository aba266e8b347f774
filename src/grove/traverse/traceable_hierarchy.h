#pragma once

// Tracing a hierarchy over a geometry: what the leaves of any walk<order>(hierarchy, ray, t_max, leaf, prefetch, counter) do.

#include <cstdint>
#include <span>
#include <utility>

#include "grove/geometry/geometry_concept.h"
#include "grove/geometry/hit_filter.h"
#include "grove/geometry/leaf_storage.h"
#include "grove/traverse/traversal_record.h"
#include "grove/traverse/walk_order.h"

namespace grove {

/// A hierarchy together with the way its leaves reach the primitives of a geometry.
template <typename Hierarchy, Geometry G>
struct TraceableHierarchy {
  Hierarchy bvh;
  LeafStorage<G> leaves;

  TraceableHierarchy(Hierarchy hierarchy, const G& geometry) : bvh(std::move(hierarchy)), leaves(geometry, bvh.references) {}

  /// Bytes kept for tracing.
  [[nodiscard]] std::size_t memory() const { return bvh.memory() + leaves.memory(); }
};

/// A geometry that is asked about all primitives of a leaf together, where no filter has a say in their hits.
template <typename G, typename C>
concept TestsLeaves = !FiltersHits<C> &&
                      requires(const G& geometry, std::span<const std::uint32_t> primitives, const typename G::PreparedRay& ray, Hit& hit) {
  geometry.intersect_leaf(primitives, ray, hit);
};

/// Closest hit. `hit.t` must start as the ray's t_max.
template <typename Hierarchy, Geometry G, typename C>
void trace_closest(const TraceableHierarchy<Hierarchy, G>& structure, const G& geometry, const Ray& ray, Hit& hit, C& counter) {
  const typename G::PreparedRay prepared = geometry.prepare(ray);
  const std::uint32_t* const references = structure.bvh.references.data();
  const auto test_leaf = [&](std::uint32_t first, std::uint32_t count) {
    if constexpr (TestsLeaves<G, C>) {
      for (std::uint32_t slot = first; slot < first + count; ++slot) count_test(counter, references[slot]);
      geometry.intersect_leaf({references + first, count}, prepared, hit);
      return false;
    }
    for (std::uint32_t slot = first; slot < first + count; ++slot) {
      count_test(counter, references[slot]);
      structure.leaves.intersect(geometry, references, slot, prepared, hit, counter);
    }
    return false;
  };
  const auto prefetch_leaf = [&](std::uint32_t first) { structure.leaves.prefetch(references, first); };
  walk<WalkOrder::nearest_first>(structure.bvh, ray, hit.t, test_leaf, prefetch_leaf, counter);
}

/// Any hit within [ray.t_min, ray.t_max].
template <typename Hierarchy, Geometry G, typename C>
bool trace_any(const TraceableHierarchy<Hierarchy, G>& structure, const G& geometry, const Ray& ray, C& counter) {
  const typename G::PreparedRay prepared = geometry.prepare(ray);
  const std::uint32_t* const references = structure.bvh.references.data();
  bool found = false;
  const auto test_leaf = [&](std::uint32_t first, std::uint32_t count) {
    if constexpr (TestsLeaves<G, C>) {
      for (std::uint32_t slot = first; slot < first + count; ++slot) count_test(counter, references[slot]);
      Hit hit;
      hit.t = ray.t_max;
      geometry.intersect_leaf({references + first, count}, prepared, hit);
      found = static_cast<bool>(hit);
      return found;
    }
    for (std::uint32_t slot = first; slot < first + count && !found; ++slot) {
      count_test(counter, references[slot]);
      found = structure.leaves.occluded(geometry, references, slot, prepared, counter);
    }
    return found;
  };
  const auto prefetch_leaf = [&](std::uint32_t first) { structure.leaves.prefetch(references, first); };
  walk<WalkOrder::largest_first>(structure.bvh, ray, ray.t_max, test_leaf, prefetch_leaf, counter);
  return found;
}

}  // namespace grove
