#pragma once

// Top-down traversal of an octree, near to far: the parameters at which a ray meets a node's three planes part its stretch in the cell among the octants (the
// parametric method of Revelles, Ureña and Lastra 2000). Differs from the paper in that all eight octants are cut out of the stretch at once, in
// registers, instead of stepping from one to the next by a table; in that planes may be anywhere (octree-R); and in that a plane is a band (octree_ray.h),
// so that stretches overlap by the error bound of hits and none can fall between octants.

#include <bit>
#include <cstdint>

#include "grove/geometry/geometry_concept.h"
#include "grove/traverse/octree_ray.h"
#include "grove/traverse/traversal_record.h"

namespace grove {

/// Walks the leaves of `tree` below the root that the ray may meet something in between `first` and the lower of `last` and `t_max`, near to far; a node's own
/// references come before its octants. `leaf(first, count)` tests references, may lower `t_max`, and returns true to end the walk. The walk ends where no
/// hit nearer than `t_max`, nor as near, can be left.
template <typename LeafTest, typename C>
void walk_top_down(const Octree& tree, const OctreeRay& octree_ray, float first, float last, const float& t_max, const LeafTest& leaf,
                   C& counter) {
  constexpr std::uint32_t kLeaf = 0x80000000U;
  struct Entry {
    std::uint32_t number;  // of a node, or of a leaf with kLeaf set
    float first, last;
  };
  Entry stack[7 * Octree::kMaxDepth + 1];
  std::uint32_t stack_size = 0;
  const OctreeNode* const nodes = tree.nodes.data();
  const std::uint32_t* const leaf_first = tree.leaf_first.data();
  const auto test = [&](std::uint32_t number) {
    count_leaf(counter, leaf_first[number]);
    return leaf(leaf_first[number], leaf_first[number + 1] - leaf_first[number]);
  };
  Entry top{0, first, last};
  for (;;) {
    if ((top.number & kLeaf) != 0) {
      if (test(top.number & ~kLeaf)) return;
    } else {
      count_node(counter, top.number);
      const OctreeNode& node = nodes[top.number];
      if (node.has_own != 0) {
        if (test(node.first_leaf)) return;
        top.last = t_max < top.last ? t_max : top.last;
      }
      OctantStretches stretches;
      std::uint32_t met = stretches.cut(octree_ray, planes_of(node), top.first, top.last);
      met &= octree_ray.flipped(node.interior_mask | node.leaf_mask);
      // The farthest is pushed first.
      while (met != 0) {
        const std::uint32_t number = 31U - static_cast<std::uint32_t>(std::countl_zero(met));
        met ^= 1U << number;
        const std::uint32_t octant = number ^ octree_ray.flip;
        const bool is_leaf = (node.leaf_mask >> octant & 1U) != 0;
        const std::uint32_t child = is_leaf ? node.leaf(octant) : node.child(octant);
        if (is_leaf) {
          __builtin_prefetch(leaf_first + child);
        } else {
          __builtin_prefetch(nodes + child);
        }
        stack[stack_size++] = {is_leaf ? child | kLeaf : child, stretches.first[number], stretches.last[number]};
      }
      counter.reach_stack_depth(stack_size);
    }
    // A tie must still be visited: the primitive there may have a lower id.
    do {
      if (stack_size == 0) return;
      top = stack[--stack_size];
    } while (top.first > t_max);
    top.last = t_max < top.last ? t_max : top.last;
  }
}

/// The same for a whole ray, which must be traceable.
template <typename LeafTest, typename C>
void walk(const Octree& tree, const Ray& ray, const float& t_max, const LeafTest& leaf, C& counter) {
  if (tree.nodes.empty()) return;
  const OctreeRay octree_ray(ray, tree.bounds);
  float first = ray.t_min > 0.0F ? ray.t_min : 0.0F;
  float last = t_max;
  octree_ray.clip(tree.bounds, first, last);
  if (first <= last) walk_top_down(tree, octree_ray, first, last, t_max, leaf, counter);
}

}  // namespace grove
