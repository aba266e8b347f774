#pragma once

// Tracing a kd-tree over a geometry.

#include <cstdint>
#include <utility>

#include "grove/geometry/geometry_concept.h"
#include "grove/geometry/leaf_storage.h"
#include "grove/traverse/kd_rope_traversal.h"
#include "grove/traverse/kd_tree_traversal.h"
#include "grove/traverse/referenced_leaves.h"

namespace grove {

/// A kd-tree together with the way its leaves reach the primitives of a geometry.
template <Geometry G>
struct TraceableKdTree {
  KdTree tree;
  KdRopes ropes;  ///< empty where rays are walked with a stack
  LeafStorage<G> leaves;
  UseMailbox mailbox;

  TraceableKdTree(KdTree kd_tree, KdRopes kd_ropes, const G& geometry, UseMailbox use_mailbox)
      : tree(std::move(kd_tree)), ropes(std::move(kd_ropes)), leaves(geometry, tree.references), mailbox(use_mailbox) {}

  /// Looks again at the geometry after the tree has changed, where `slots` (a span of stretches with `first` and `count`) say that references have.
  template <typename Slots>
  void refresh(const G& geometry, const Slots& slots) {
    leaves.resize(tree.references.size());
    parallel_for(slots.size(), 64, [&](std::size_t i) {
      parallel_ranges(slots[i].count, 16384, [&](std::size_t first, std::size_t last) {
        bool all_hittable = true;  // as all are that a tree refers to
        static_cast<void>(leaves.refresh(geometry, tree.references.data(), slots[i].first + static_cast<std::uint32_t>(first),
                                         static_cast<std::uint32_t>(last - first), all_hittable));
      });
    });
  }

  /// Bytes kept for tracing.
  [[nodiscard]] std::size_t memory() const { return tree.memory() + ropes.memory() + leaves.memory(); }
};

namespace detail {

template <Geometry G, typename LeafTest, typename C>
void walk_by_either(const TraceableKdTree<G>& structure, const Ray& ray, const float& t_max, const LeafTest& leaf, C& counter) {
  if (structure.ropes.is_empty()) {
    walk(structure.tree, ray, t_max, leaf, counter);
  } else {
    walk(structure.tree, structure.ropes, ray, t_max, leaf, counter);
  }
}

}  // namespace detail

/// Closest hit. `hit.t` must start as the ray's t_max.
template <Geometry G, typename C>
void trace_closest(const TraceableKdTree<G>& structure, const G& geometry, const Ray& ray, Hit& hit, C& counter) {
  const auto walk_leaves = [&](const float& t_max, const auto& leaf) { detail::walk_by_either(structure, ray, t_max, leaf, counter); };
  trace_closest_in_leaves(geometry, structure.leaves, structure.tree.references.data(), structure.mailbox, ray, hit, walk_leaves, counter);
}

/// Any hit within [ray.t_min, ray.t_max].
template <Geometry G, typename C>
bool trace_any(const TraceableKdTree<G>& structure, const G& geometry, const Ray& ray, C& counter) {
  const auto walk_leaves = [&](const float& t_max, const auto& leaf) { detail::walk_by_either(structure, ray, t_max, leaf, counter); };
  return trace_any_in_leaves(geometry, structure.leaves, structure.tree.references.data(), structure.mailbox, ray, walk_leaves, counter);
}

}  // namespace grove
