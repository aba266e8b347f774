#include "grove/accel/wide_bvh.h"

#include <algorithm>

#include "grove/accel/bvh2.h"

namespace grove {

template <int kWidth>
std::string WideBvh<kWidth>::validate(std::size_t primitive_count) const {
  if (references.empty()) return nodes.empty() && bounds.is_empty() && depth == 0 ? "" : "an empty hierarchy has nodes, bounds or depth";
  std::vector<bool> node_seen(nodes.size(), false);
  std::vector<bool> reference_seen(references.size(), false);
  for (const std::uint32_t reference : references)
    if (reference >= primitive_count) return "a reference names a primitive that is not there";
  std::uint32_t deepest = 0;
  std::string problem;
  const auto check_leaf = [&](std::uint32_t first, std::uint32_t count) {
    if (first + std::size_t{count} > references.size()) {
      problem = "a leaf reaches past the references";
      return;
    }
    for (std::uint32_t i = first; i < first + count; ++i) {
      if (reference_seen[i]) problem = "a reference lies in two leaves";
      reference_seen[i] = true;
    }
  };
  struct Pending {
    Box box;
    std::uint32_t depth, first, count;
  };
  std::vector<Pending> stack{{bounds, 0, 0, nodes.empty() ? static_cast<std::uint32_t>(references.size()) : 0}};
  while (!stack.empty() && problem.empty()) {
    const Pending top = stack.back();
    stack.pop_back();
    deepest = std::max(deepest, top.depth);
    if (top.count > 0) {
      check_leaf(top.first, top.count);
      continue;
    }
    if (top.first >= nodes.size()) return "a child names a node that is not there";
    if (node_seen[top.first]) return "a node has two parents";
    node_seen[top.first] = true;
    const WideNode<kWidth>& node = nodes[top.first];
    if (!node.has_child(1)) return "a node has fewer than two children";
    for (int i = 0; i < kWidth; ++i) {
      if (!node.has_child(i)) continue;
      if (i > 0 && !node.has_child(i - 1)) return "a node has a gap between its children";
      if (!top.box.contains(node.child_box(i))) return "a child reaches outside its parent";
      if (node.child[i].count == 0 && node.child[i].first <= top.first) return "a node has a child before it";
      stack.push_back({node.child_box(i), top.depth + 1, node.child[i].first, node.child[i].count});
    }
  }
  if (!problem.empty()) return problem;
  if (deepest != depth) return "the depth is " + std::to_string(deepest) + ", not " + std::to_string(depth) + " as stated";
  if (deepest > Bvh2::kMaxDepth) return "deeper than the traversal stack";
  if (std::find(node_seen.begin(), node_seen.end(), false) != node_seen.end()) return "a node is not reached";
  if (std::find(reference_seen.begin(), reference_seen.end(), false) != reference_seen.end()) return "a reference lies in no leaf";
  return "";
}

template struct WideBvh<4>;
template struct WideBvh<8>;

}  // namespace grove
