#pragma once

// What a walk through cells does in a leaf, whatever the structure: test what the leaf refers to, with or without a mailbox.

#include <cstdint>

#include "grove/geometry/geometry_concept.h"
#include "grove/geometry/leaf_storage.h"
#include "grove/traverse/mailbox.h"
#include "grove/traverse/traversal_record.h"

namespace grove {

enum class UseMailbox : std::uint8_t { no, yes };

namespace detail {

template <typename M, Geometry G, typename Walk, typename C>
void closest_in_leaves(const G& geometry, const LeafStorage<G>& leaves, const std::uint32_t* references, const Ray& ray, Hit& hit,
                       const Walk& walk_leaves, C& counter) {
  M mailbox;
  const typename G::PreparedRay prepared = geometry.prepare(ray);
  walk_leaves(hit.t, [&](std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t slot = first; slot < first + count; ++slot) {
      if (mailbox.remembers(references[slot])) continue;
      count_test(counter, references[slot]);
      leaves.intersect(geometry, references, slot, prepared, hit, counter);
    }
    return false;
  });
}

template <typename M, Geometry G, typename Walk, typename C>
bool any_in_leaves(const G& geometry, const LeafStorage<G>& leaves, const std::uint32_t* references, const Ray& ray,
                   const Walk& walk_leaves, C& counter) {
  M mailbox;
  const typename G::PreparedRay prepared = geometry.prepare(ray);
  bool found = false;
  walk_leaves(ray.t_max, [&](std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t slot = first; slot < first + count && !found; ++slot) {
      if (mailbox.remembers(references[slot])) continue;
      count_test(counter, references[slot]);
      found = leaves.occluded(geometry, references, slot, prepared, counter);
    }
    return found;
  });
  return found;
}

}  // namespace detail

/// Closest hit among the leaves that a walk comes to. `walk_leaves(t_max, leaf)` calls leaf(first, count) for them and may end where nothing nearer than
/// `t_max`, nor as near, can be left; `hit.t` must start as the ray's t_max and is what `t_max` refers to.
template <Geometry G, typename Walk, typename C>
void trace_closest_in_leaves(const G& geometry, const LeafStorage<G>& leaves, const std::uint32_t* references, UseMailbox mailbox,
                             const Ray& ray, Hit& hit, const Walk& walk_leaves, C& counter) {
  if (mailbox == UseMailbox::yes) {
    detail::closest_in_leaves<Mailbox>(geometry, leaves, references, ray, hit, walk_leaves, counter);
  } else {
    detail::closest_in_leaves<NoMailbox>(geometry, leaves, references, ray, hit, walk_leaves, counter);
  }
}

/// Any hit within [ray.t_min, ray.t_max]; the walk ends when a leaf returns true.
template <Geometry G, typename Walk, typename C>
bool trace_any_in_leaves(const G& geometry, const LeafStorage<G>& leaves, const std::uint32_t* references, UseMailbox mailbox,
                         const Ray& ray, const Walk& walk_leaves, C& counter) {
  if (mailbox == UseMailbox::yes) return detail::any_in_leaves<Mailbox>(geometry, leaves, references, ray, walk_leaves, counter);
  return detail::any_in_leaves<NoMailbox>(geometry, leaves, references, ray, walk_leaves, counter);
}

}  // namespace grove
