#include "grove/accel/bvh2.h"

#include <algorithm>

namespace grove {

std::string Bvh2::validate(std::size_t primitive_count) const {
  if (references.empty()) return nodes.empty() && bounds.is_empty() && depth == 0 ? "" : "an empty hierarchy has nodes, bounds or depth";

  std::vector<bool> node_seen(nodes.size(), false);
  std::vector<bool> reference_seen(references.size(), false);
  std::uint32_t deepest = 0;
  struct Pending {
    Box box;
    std::uint32_t depth, first, count;
  };
  std::vector<Pending> stack{{bounds, 0, 0, nodes.empty() ? static_cast<std::uint32_t>(references.size()) : 0}};
  while (!stack.empty()) {
    const Pending top = stack.back();
    stack.pop_back();
    deepest = std::max(deepest, top.depth);
    if (top.count > 0) {
      if (top.first + std::size_t{top.count} > references.size()) return "a leaf reaches past the references";
      for (std::uint32_t i = top.first; i < top.first + top.count; ++i) {
        if (reference_seen[i]) return "reference " + std::to_string(i) + " lies in two leaves";
        if (references[i] >= primitive_count) return "reference " + std::to_string(i) + " names a primitive that is not there";
        reference_seen[i] = true;
      }
      continue;
    }
    if (top.first >= nodes.size()) return "a child names a node that is not there";
    if (node_seen[top.first]) return "node " + std::to_string(top.first) + " has two parents";
    node_seen[top.first] = true;
    const Bvh2Node& node = nodes[top.first];
    for (int child = 0; child < 2; ++child) {
      const Box box = node.child_box(child);
      if (box.is_empty()) return "a child of node " + std::to_string(top.first) + " has an empty box";
      if (!top.box.contains(box)) return "a child of node " + std::to_string(top.first) + " reaches outside its parent";
      stack.push_back({box, top.depth + 1, node.child[child].first, node.child[child].count});
    }
  }
  if (deepest != depth) return "the depth is " + std::to_string(deepest) + ", not " + std::to_string(depth) + " as stated";
  if (deepest > kMaxDepth) return "deeper than the traversal stack";
  if (std::find(node_seen.begin(), node_seen.end(), false) != node_seen.end()) return "a node is not reached";
  if (std::find(reference_seen.begin(), reference_seen.end(), false) != reference_seen.end()) return "a reference lies in no leaf";
  return "";
}

}  // namespace grove
