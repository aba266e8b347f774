#pragma once

// Ordered depth-first traversal of a kd-tree (Havran 2000, "Heuristic Ray Shooting Algorithms", the recursive algorithm with a stack): the ray's stretch
// inside a cell is cut at the plane; the nearer part goes on, the farther waits on a stack. Cells come in the order of the ray, so the walk ends with the
// first hit that lies before everything that waits. Differs from the paper in that a plane is a band (kd_ray.h): the two parts of a stretch overlap by the
// error bound of hits, so that no hit can fall between cells, whatever side of a plane it or its primitive is on.

#include <cstdint>

#include "grove/accel/kd_tree.h"
#include "grove/geometry/geometry_concept.h"
#include "grove/traverse/kd_ray.h"

namespace grove {

/// Walks the cells of `tree` that `kd_ray` may meet something in between `first` and the lower of `last` and `t_max`, near to far. `leaf(first, count)`
/// tests references, may lower `t_max`, and returns true to end the walk. The walk ends where no hit nearer than `t_max`, nor as near, can be left.
template <typename LeafTest, typename C>
void walk_with_stack(const KdTree& tree, const KdRay& kd_ray, float first, float last, const float& t_max, const LeafTest& leaf,
                     C& counter) {
  struct Entry {
    std::uint32_t node;
    float first, last;
  };
  Entry stack[KdTree::kMaxDepth];
  std::uint32_t stack_size = 0;
  const KdNode* const nodes = tree.nodes.data();
  std::uint32_t index = 0;
  for (;;) {
    KdNode node = nodes[index];
    while (!node.is_leaf()) {
      counter.visit_node();
      const std::uint32_t axis = node.axis();
      const float entry = kd_ray.entry(axis, node.plane());
      const float departure = kd_ray.departure(axis, node.plane());
      const std::uint32_t near = node.lower_child() + kd_ray.near_side(axis);
      if (entry > last) {
        index = near;
      } else {
        const std::uint32_t far = near ^ 1U;
        if (departure < first) {
          index = far;
        } else {
          stack[stack_size++] = {far, entry > first ? entry : first, last};
          counter.reach_stack_depth(stack_size);
          index = near;
          last = departure < last ? departure : last;
        }
      }
      node = nodes[index];
    }
    if (node.count() > 0) {
      counter.enter_leaf();
      if (leaf(node.first(), node.count())) return;
    }
    // A tie must still be visited: the primitive there may have a lower id.
    do {
      if (stack_size == 0) return;
      --stack_size;
    } while (stack[stack_size].first > t_max);
    index = stack[stack_size].node;
    first = stack[stack_size].first;
    last = stack[stack_size].last < t_max ? stack[stack_size].last : t_max;
  }
}

/// The same for a whole ray, which must be traceable.
template <typename LeafTest, typename C>
void walk(const KdTree& tree, const Ray& ray, const float& t_max, const LeafTest& leaf, C& counter) {
  if (tree.nodes.empty()) return;
  const KdRay kd_ray(ray, tree.bounds);
  float first = ray.t_min > 0.0F ? ray.t_min : 0.0F;
  float last = t_max;
  kd_ray.clip(tree.bounds, first, last);
  if (first <= last) walk_with_stack(tree, kd_ray, first, last, t_max, leaf, counter);
}

}  // namespace grove
