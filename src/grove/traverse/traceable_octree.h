#pragma once

// Tracing an octree over a geometry.

#include <utility>

#include "grove/traverse/octree_neighbour_traversal.h"
#include "grove/traverse/referenced_leaves.h"

namespace grove {

enum class OctreeWalk : std::uint8_t { top_down, neighbour };

/// An octree together with the way its leaves reach the primitives of a geometry.
template <Geometry G>
struct TraceableOctree {
  Octree tree;
  LeafStorage<G> leaves;
  OctreeWalk how_to_walk;
  UseMailbox mailbox;

  TraceableOctree(Octree octree, const G& geometry, OctreeWalk octree_walk, UseMailbox use_mailbox)
      : tree(std::move(octree)), leaves(geometry, tree.references), how_to_walk(octree_walk), mailbox(use_mailbox) {}

  /// Bytes kept for tracing.
  [[nodiscard]] std::size_t memory() const { return tree.memory() + leaves.memory(); }
};

namespace detail {

template <Geometry G, typename LeafTest, typename C>
void walk_by_either(const TraceableOctree<G>& structure, const Ray& ray, const float& t_max, const LeafTest& leaf, C& counter) {
  if (structure.how_to_walk == OctreeWalk::top_down) {
    walk(structure.tree, ray, t_max, leaf, counter);
  } else {
    walk_by_neighbours(structure.tree, ray, t_max, leaf, counter);
  }
}

}  // namespace detail

/// Closest hit. `hit.t` must start as the ray's t_max.
template <Geometry G, typename C>
void trace_closest(const TraceableOctree<G>& structure, const G& geometry, const Ray& ray, Hit& hit, C& counter) {
  const auto walk_leaves = [&](const float& t_max, const auto& leaf) { detail::walk_by_either(structure, ray, t_max, leaf, counter); };
  trace_closest_in_leaves(geometry, structure.leaves, structure.tree.references.data(), structure.mailbox, ray, hit, walk_leaves, counter);
}

/// Any hit within [ray.t_min, ray.t_max].
template <Geometry G, typename C>
bool trace_any(const TraceableOctree<G>& structure, const G& geometry, const Ray& ray, C& counter) {
  const auto walk_leaves = [&](const float& t_max, const auto& leaf) { detail::walk_by_either(structure, ray, t_max, leaf, counter); };
  return trace_any_in_leaves(geometry, structure.leaves, structure.tree.references.data(), structure.mailbox, ray, walk_leaves, counter);
}

}  // namespace grove
