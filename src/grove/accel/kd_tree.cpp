#include "grove/accel/kd_tree.h"

#include <algorithm>

namespace grove {
namespace {

// The first fault of a leaf in words, or an empty string.
std::string fault_of_leaf(const KdTree& tree, const KdNode& leaf, std::uint32_t expected_first, std::size_t primitive_count) {
  if (leaf.first() != expected_first) return "a leaf does not begin where the one before it ends";
  if (leaf.first() + std::size_t{leaf.count()} > tree.references.size()) return "a leaf reaches past the references";
  for (std::uint32_t i = leaf.first(); i < leaf.first() + leaf.count(); ++i) {
    if (tree.references[i] >= primitive_count) return "reference " + std::to_string(i) + " names a primitive that is not there";
    if (i > leaf.first() && tree.references[i] <= tree.references[i - 1]) return "the references of a leaf do not ascend";
  }
  return "";
}

}  // namespace

std::string KdTree::validate(std::size_t primitive_count) const {
  if (nodes.empty()) return references.empty() && bounds.is_empty() && depth == 0 ? "" : "an empty tree has references, bounds or depth";
  if (nodes.size() % 2 != 0 || nodes.size() > kMaxNodes) return "nodes do not come in pairs, or are too many";
  // The visit below must not run astray: a child comes after its parent, and no pair has two parents.
  std::vector<bool> has_parent(nodes.size() / 2, false);
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    if (i == 1 || nodes[i].is_leaf()) continue;
    const std::uint32_t child = nodes[i].lower_child();
    if (child % 2 != 0 || child <= i || child + 1 >= nodes.size()) return "node " + std::to_string(i) + " names a child that cannot be";
    if (has_parent[child / 2]) return "the pair at " + std::to_string(child) + " has two parents";
    has_parent[child / 2] = true;
  }
  has_parent[0] = true;
  if (std::find(has_parent.begin(), has_parent.end(), false) != has_parent.end()) return "a node is not reached";

  std::string fault;
  std::uint32_t deepest = 0;
  std::uint32_t next_reference = 0;
  visit([&](const Box& cell, std::uint32_t node_depth, const KdNode& node) {
    if (!fault.empty()) return;
    deepest = std::max(deepest, node_depth);
    if (node.is_leaf()) {
      fault = fault_of_leaf(*this, node, next_reference, primitive_count);
      next_reference += node.count();
      return;
    }
    const int axis = static_cast<int>(node.axis());
    if (!(cell.lower[axis] < node.plane() && node.plane() < cell.upper[axis])) fault = "a plane is not inside its cell";
  });
  if (!fault.empty()) return fault;
  if (next_reference != references.size()) return "a reference lies in no leaf";
  if (deepest != depth) return "the depth is " + std::to_string(deepest) + ", not " + std::to_string(depth) + " as stated";
  return depth <= kMaxDepth ? "" : "deeper than the traversal stack";
}

}  // namespace grove
