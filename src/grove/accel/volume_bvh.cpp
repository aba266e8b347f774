#include "grove/accel/volume_bvh.h"

#include <algorithm>
#include <limits>

namespace grove {
namespace {

// Marks [first, first + count); false when that reaches past the end or is marked in part already.
bool mark(std::vector<bool>& seen, std::size_t first, std::size_t count) {
  if (first + count > seen.size()) return false;
  for (std::size_t i = first; i < first + count; ++i) {
    if (seen[i]) return false;
    seen[i] = true;
  }
  return true;
}

}  // namespace

template <BoundingVolume V>
std::string VolumeBvh<V>::validate(std::size_t primitive_count) const {
  if (references.empty() || nodes.empty()) {
    const bool is_empty = references.empty() && nodes.empty() && bounds.is_empty() && depth == 0;
    return is_empty ? "" : "an empty hierarchy has nodes, references, bounds or depth";
  }
  for (const std::uint32_t reference : references)
    if (reference >= primitive_count) return "a reference names a primitive that is not there";
  std::vector<bool> node_seen(nodes.size(), false);
  std::vector<bool> reference_seen(references.size(), false);
  node_seen[0] = true;
  std::uint32_t deepest = 0;
  struct Pending {
    std::uint32_t node, depth;
  };
  std::vector<Pending> stack{{0, 0}};
  while (!stack.empty()) {
    const Pending top = stack.back();
    stack.pop_back();
    deepest = std::max(deepest, top.depth);
    const VolumeNode<V>& node = nodes[top.node];
    const std::string name = "node " + std::to_string(top.node);
    const float area = node.volume.half_area();
    if (!(area >= 0.0F && area <= std::numeric_limits<float>::max())) return name + " has a volume without a finite area";
    if (node.is_leaf) {
      if (node.count == 0) return name + " is a leaf without references";
      if (!mark(reference_seen, node.first, node.count)) return name + " names references that are not there or lie in another leaf";
      continue;
    }
    if (node.count < 2 || node.count > kMaxArity) return name + " has " + std::to_string(node.count) + " children";
    if (node.first <= top.node) return name + " has a child before it";
    if (!mark(node_seen, node.first, node.count)) return name + " has children that are not there or have another parent";
    for (std::uint32_t i = 0; i < node.count; ++i) stack.push_back({node.first + i, top.depth + 1});
  }
  if (deepest != depth) return "the depth is " + std::to_string(deepest) + ", not " + std::to_string(depth) + " as stated";
  if (deepest > kMaxDepth) return "deeper than the traversal stack";
  if (std::find(node_seen.begin(), node_seen.end(), false) != node_seen.end()) return "a node is not reached";
  if (std::find(reference_seen.begin(), reference_seen.end(), false) != reference_seen.end()) return "a reference lies in no leaf";
  return "";
}

template struct VolumeBvh<OrientedBox>;
template struct VolumeBvh<BoundingSphere>;

}  // namespace grove
