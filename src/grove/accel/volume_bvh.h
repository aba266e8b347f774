#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "grove/accel/bvh2.h"
#include "grove/base/huge_vector.h"
#include "grove/math/bounding_sphere.h"
#include "grove/math/bounding_volume.h"
#include "grove/math/box.h"
#include "grove/math/oriented_box.h"
#include "grove/math/unit_space.h"

namespace grove {

/// A node with its own volume, which the ray is tested against before the node is entered. The children of a node stand together.
///
///   first `sizeof(V)` bytes  the volume, in unit space
///   4 bytes                  of an interior node the number of its first child, of a leaf that of its first reference
///   4 bytes                  how many children or references there are; the highest bit tells leaves
template <BoundingVolume V>
struct VolumeNode {
  V volume;
  std::uint32_t first;
  std::uint32_t count : 31;
  std::uint32_t is_leaf : 1;
};

static_assert(sizeof(VolumeNode<OrientedBox>) == 68);
static_assert(sizeof(VolumeNode<BoundingSphere>) == 24);

/// A bounding volume hierarchy over any volume and with any number of children up to kMaxArity, as plain data.
///
/// Node 0 is the root; children have higher numbers than their parent. Volumes enclose the primitives below them, not each other: a child
/// may stick out of its parent, where nothing is.
template <BoundingVolume V>
struct VolumeBvh {
  static constexpr std::uint32_t kMaxArity = 8;
  static constexpr std::uint32_t kMaxDepth = Bvh2::kMaxDepth;

  HugeVector<VolumeNode<V>> nodes;       ///< empty when there are no references
  HugeVector<std::uint32_t> references;  ///< primitive ids, leaf by leaf
  Box bounds;                            ///< of the primitives, in the scene's coordinates
  UnitSpace space;                       ///< the coordinates of the volumes
  std::uint32_t depth = 0;               ///< edges from the root to the deepest leaf; at most kMaxDepth

  [[nodiscard]] std::size_t memory() const { return nodes.size() * sizeof(VolumeNode<V>) + references.size() * sizeof(std::uint32_t); }

  /// The first broken invariant in words, or an empty string: each reference in exactly one leaf and below `primitive_count`, each node
  /// reached once, two to kMaxArity children, volumes of a finite area, `depth` as found. O(nodes + references).
  [[nodiscard]] std::string validate(std::size_t primitive_count) const;

  /// Calls visitor(node, depth) for each node and leaf in depth-first order, parents first.
  template <typename Visitor>
  void visit_nodes(const Visitor& visitor) const;

  /// Calls visitor(box, depth, first, count) likewise; count is 0 for an interior node. `box` is the axis-aligned box around the
  /// volume as far as it lies inside the bounds.
  template <typename Visitor>
  void visit(const Visitor& visitor) const;
};

template <BoundingVolume V>
template <typename Visitor>
void VolumeBvh<V>::visit_nodes(const Visitor& visitor) const {
  if (nodes.empty()) return;
  struct Pending {
    std::uint32_t node, depth;
  };
  std::vector<Pending> stack{{0, 0}};
  while (!stack.empty()) {
    const Pending top = stack.back();
    stack.pop_back();
    const VolumeNode<V>& node = nodes[top.node];
    visitor(node, top.depth);
    if (node.is_leaf) continue;
    for (std::uint32_t i = node.count; i-- > 0;) stack.push_back({node.first + i, top.depth + 1});
  }
}

template <BoundingVolume V>
template <typename Visitor>
void VolumeBvh<V>::visit(const Visitor& visitor) const {
  visit_nodes([&](const VolumeNode<V>& node, std::uint32_t node_depth) {
    const std::uint32_t count = node.is_leaf ? node.count : 0;
    visitor(space.to_scene(node.volume.bounds()).intersection(bounds), node_depth, node.first, count);
  });
}

extern template struct VolumeBvh<OrientedBox>;
extern template struct VolumeBvh<BoundingSphere>;

}  // namespace grove
