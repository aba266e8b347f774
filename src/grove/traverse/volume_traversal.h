#pragma once

// Ordered depth-first traversal of a hierarchy over any volume: the children of a node are tested one after another, those that are met are entered near to
// far, or the largest first. Otherwise as traverse/bvh2_traversal.h.

#include <cstdint>

#include "grove/accel/volume_bvh.h"
#include "grove/geometry/geometry_concept.h"
#include "grove/traverse/bounding_sphere_test.h"
#include "grove/traverse/oriented_box_test.h"
#include "grove/traverse/traversal_record.h"
#include "grove/traverse/unit_ray.h"
#include "grove/traverse/walk_order.h"

namespace grove {

/// Walks the leaves that the ray meets; the contract is that of the walk through a Bvh2.
template <WalkOrder kOrder, BoundingVolume V, typename LeafTest, typename LeafPrefetch, typename C>
void walk(const VolumeBvh<V>& bvh, const Ray& ray, const float& t_max, const LeafTest& leaf, const LeafPrefetch& prefetch_leaf,
          C& counter) {
  if (bvh.nodes.empty()) return;
  struct Entry {
    const VolumeNode<V>* node;
    float distance;
  };
  // Each level leaves at most kMaxArity - 1 behind.
  Entry stack[(VolumeBvh<V>::kMaxArity - 1) * VolumeBvh<V>::kMaxDepth + VolumeBvh<V>::kMaxArity];
  std::uint32_t stack_size = 0;
  const UnitRay unit_ray(ray, bvh.space, bvh.bounds);
  const VolumeTest<V> test(unit_ray);
  float limit = unit_ray.distance(t_max);
  const VolumeNode<V>* const nodes = bvh.nodes.data();
  const VolumeNode<V>* node = nodes;
  for (;;) {
    if (node->is_leaf != 0) {
      count_leaf(counter, node->first);
      if (leaf(node->first, std::uint32_t{node->count})) return;
      limit = unit_ray.distance(t_max);
    } else {
      count_node(counter, node->first);
      const std::uint32_t bottom = stack_size;
      const VolumeNode<V>* const end = nodes + node->first + node->count;
      for (const VolumeNode<V>* child = nodes + node->first; child != end; ++child) {
        float distance;
        if (!test(child->volume, limit, distance)) continue;
        // Distances are of no use where the first hit ends the walk.
        if constexpr (kOrder == WalkOrder::largest_first) distance = -child->volume.half_area();
        if (child->is_leaf != 0) {
          prefetch_leaf(child->first);
        } else {
          const char* const line = reinterpret_cast<const char*>(nodes + child->first);
          for (std::size_t offset = 0; offset < 2 * sizeof(VolumeNode<V>); offset += 64) __builtin_prefetch(line + offset);
        }
        // Insertion by distance, the nearest on top; mostly there are one or two.
        std::uint32_t place = stack_size++;
        for (; place > bottom && stack[place - 1].distance < distance; --place) stack[place] = stack[place - 1];
        stack[place] = {child, distance};
      }
      counter.reach_stack_depth(stack_size);
      if (stack_size > bottom) {
        node = stack[--stack_size].node;
        continue;
      }
    }
    // A tie must still be visited: the primitive there may have a lower id.
    do {
      if (stack_size == 0) return;
      --stack_size;
    } while (stack[stack_size].distance > limit);
    node = stack[stack_size].node;
  }
}

}  // namespace grove
