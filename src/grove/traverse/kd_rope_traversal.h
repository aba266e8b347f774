#pragma once

// Stackless traversal of a kd-tree by ropes (Popov, Günther, Seidel and Slusallek 2007): from a leaf, the face through which the ray leaves tells the
// node behind it, and from there the ray goes down to the next leaf.
//
// One path of cells is enough only where there is no doubt about it. A plane is a band for a ray (kd_ray.h), so crossing a face takes a stretch of t, the
// crossing. In it the ray may meet what is in the leaf or in the one behind the face, and in no other if during all of it the ray is outside the bands
// of the leaf's other faces and of the planes on the way down. Where that is in doubt (rays through edges and corners of cells, in planes, or cells
// smaller than rounding), the walk with a stack takes over from the start of the crossing. Before the crossing everything has been tested; so the hits are
// the same. This replaces the epsilons with which the paper locates the point of entry.

#include <cstdint>

#include "grove/accel/kd_ropes.h"
#include "grove/traverse/kd_tree_traversal.h"

namespace grove {

/// The stretch of a ray in which it may be on both sides of a face.
struct KdCrossing {
  float first, last;
};

/// Where a ray goes from a leaf: through one face, or undecided.
struct KdWayOut {
  KdCrossing crossing;
  std::uint32_t face;
  bool is_certain;

  KdWayOut(const KdRopedLeaf& leaf, const KdRay& kd_ray) {
    float entries[3];
    std::uint32_t axis = 0;
    for (std::uint32_t i = 0; i < 3; ++i) {
      entries[i] = kd_ray.entry(i, far_side(leaf.cell, kd_ray, i));
      if (entries[i] < entries[axis]) axis = i;
    }
    crossing = {entries[axis], kd_ray.departure(axis, far_side(leaf.cell, kd_ray, axis))};
    face = 2 * axis + 1 - kd_ray.near_side(axis);
    // Written so that NaN is doubt.
    is_certain = crossing.first <= crossing.last && crossing.last < entries[(axis + 1) % 3] && crossing.last < entries[(axis + 2) % 3];
  }

 private:
  static float far_side(const Box& cell, const KdRay& kd_ray, std::uint32_t axis) {
    const int i = static_cast<int>(axis);
    return kd_ray.near_side(axis) != 0 ? cell.lower[i] : cell.upper[i];
  }
};

/// As `walk` of kd_tree_traversal.h, for a tree with ropes. The counter counts leaves that are passed through as nodes, too: leaving one takes as long.
template <typename LeafTest, typename C>
void walk(const KdTree& tree, const KdRopes& ropes, const Ray& ray, const float& t_max, const LeafTest& leaf, C& counter) {
  if (tree.nodes.empty()) return;
  const KdRay kd_ray(ray, tree.bounds);
  float first = ray.t_min > 0.0F ? ray.t_min : 0.0F;
  float last = t_max;
  kd_ray.clip(tree.bounds, first, last);
  if (!(first <= last)) return;

  // Coming into the tree is a crossing too, of up to three faces.
  KdCrossing crossing{first, first};
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const int i = static_cast<int>(axis);
    const float inside = kd_ray.departure(axis, kd_ray.near_side(axis) != 0 ? tree.bounds.upper[i] : tree.bounds.lower[i]);
    if (!(inside <= crossing.last)) crossing.last = inside;
  }
  const KdNode* const nodes = tree.nodes.data();
  std::uint32_t index = 0;
  for (;;) {
    KdNode node = nodes[index];
    bool is_certain = true;
    while (!node.is_leaf()) {
      count_node(counter, node.lower_child());
      const std::uint32_t near = node.lower_child() + kd_ray.near_side(node.axis());
      if (crossing.last < kd_ray.entry(node.axis(), node.plane())) {
        index = near;
      } else if (crossing.first > kd_ray.departure(node.axis(), node.plane())) {
        index = near ^ 1U;
      } else {
        is_certain = false;
        break;
      }
      node = nodes[index];
    }
    if (!is_certain) break;
    const KdRopedLeaf& roped = ropes.leaves[node.first()];
    count_cell(counter, node.first());
    if (roped.count > 0) {
      count_leaf(counter, node.first());
      if (leaf(roped.first, roped.count)) return;
    }
    const KdWayOut out(roped, kd_ray);
    // Whatever is left lies beyond. A tie must still be looked for.
    if (out.crossing.first > t_max) return;
    if (!out.is_certain) {
      crossing.first = out.crossing.first > crossing.first ? out.crossing.first : crossing.first;
      break;
    }
    index = roped.ropes[out.face];
    if (index == KdRopedLeaf::kOutside) return;
    crossing = out.crossing;
  }
  const auto roped_leaf = [&](std::uint32_t number, std::uint32_t count) { return leaf(ropes.leaves[number].first, count); };
  last = last < t_max ? last : t_max;
  walk_with_stack(tree, kd_ray, crossing.first > first ? crossing.first : first, last, t_max, roped_leaf, counter);
}

}  // namespace grove
