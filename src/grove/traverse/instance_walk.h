#pragma once

// A ray's way through a wide hierarchy over instances that stops at each of them, so that others can be traced in between.

#include <cstddef>
#include <cstdint>
#include <limits>

#include "grove/accel/wide_bvh.h"
#include "grove/geometry/instance_set.h"
#include "grove/traverse/slab_ray.h"
#include "grove/traverse/wide_traversal.h"

namespace grove {

/// One ray's way through the hierarchy, which it can be made to go on with. Hundreds wait at a time, so it keeps numbers and no registers: three cache lines,
/// and its stack elsewhere.
class InstanceWalk {
 public:
  using Child = WideNode<8>::Child;
  using Entry = WaitingChild<Child>;

  /// So many entries a stack needs. Each level leaves at most seven behind; the root, and one more at the last.
  [[nodiscard]] static std::size_t stack_capacity(const WideBvh<8>& bvh) { return 7 * (std::size_t{bvh.depth} + 1) + 2; }

  InstanceWalk(const WideBvh<8>& bvh, const Ray& ray, std::uint32_t index, Entry* stack)
      : prepared_(InstanceSet::prepare(ray)), slab_ray_(ray, bvh.bounds), index_(index), stack_(stack) {
    hit.t = ray.t_max;
    if (bvh.nodes.empty()) {
      leaf_ = {0, static_cast<std::uint32_t>(bvh.references.size())};
    } else {
      stack_[stack_size_++] = {{0, 0}, -std::numeric_limits<float>::infinity()};
    }
  }

  Hit hit;  ///< the closest so far; its t is how far the ray goes

  [[nodiscard]] std::uint32_t index() const { return index_; }

  /// Goes on to the next instance that may be hit, and writes the ray in its space. Returns false at the end.
  bool advance(const WideBvh<8>& bvh, const InstanceSet& instances, std::uint32_t& instance, Ray& object_ray) {
    if (enter_next(bvh, instances, instance, object_ray)) return true;
    const WideSlabs<8> slabs(slab_ray_);
    const Float4 t_min = splat(prepared_.ray.t_min > 0.0F ? prepared_.ray.t_min : 0.0F);
    for (;;) {
      Entry top;
      do {
        if (stack_size_ == 0) return false;
        top = stack_[--stack_size_];
        // A tie must still be visited: the instance there may have a lower number.
      } while (top.t > hit.t);
      if (top.child.is_leaf()) {
        leaf_ = top.child;
        if (enter_next(bvh, instances, instance, object_ray)) return true;
      } else {
        const WideNode<8>& node = bvh.nodes[top.child.node()];
        float entry[8];
        const unsigned met = slabs.test(node, t_min, splat(hit.t), entry);
        push_near_to_far(node.child, met, entry, stack_, stack_size_, [](Child /*child*/) {});
      }
    }
  }

 private:
  // The next instance of the leaf that may be hit.
  bool enter_next(const WideBvh<8>& bvh, const InstanceSet& instances, std::uint32_t& instance, Ray& object_ray) {
    while (leaf_.count > 0) {
      instance = bvh.references[leaf_.first];
      leaf_ = {leaf_.first + 1, leaf_.count - 1};
      if (instances.enter(instance, prepared_, hit.t, object_ray)) return true;
    }
    return false;
  }

  InstanceSet::PreparedRay prepared_;
  SlabRay slab_ray_;
  std::uint32_t index_;
  Entry* stack_;
  std::uint32_t stack_size_ = 0;
  Child leaf_{0, 0};
};

}  // namespace grove
