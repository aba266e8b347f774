#include "grove/accel/octree.h"

#include <algorithm>

namespace grove {
namespace {

// The first fault of what a node says of its children, or an empty string. Children and leaves must be the next that no node has named yet.
std::string fault_of_links(const Octree& tree) {
  std::vector<bool> is_named(tree.nodes.size(), false);
  std::vector<bool> has_leaf(tree.leaf_count(), false);
  is_named[0] = true;
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
    const OctreeNode& node = tree.nodes[i];
    const std::string name = "node " + std::to_string(i);
    if ((node.interior_mask & node.leaf_mask) != 0 || node.has_own > 1 || node.cut_axes > 7) return name + " has an octant of two kinds";
    const std::uint32_t children = count_octants(node.interior_mask);
    if (children == 0 && node.leaf_count() == 0) return name + " has nothing in it";
    if (children > 0 && (node.first_child <= i || node.first_child + std::size_t{children} > tree.nodes.size()))
      return name + " names a child that cannot be";
    if (node.first_leaf + std::size_t{node.leaf_count()} > tree.leaf_count()) return name + " names a leaf that is not there";
    for (std::uint32_t child = node.first_child; child < node.first_child + children; ++child) {
      if (is_named[child]) return "node " + std::to_string(child) + " has two parents";
      is_named[child] = true;
    }
    for (std::uint32_t leaf = node.first_leaf; leaf < node.first_leaf + node.leaf_count(); ++leaf) {
      if (has_leaf[leaf]) return "leaf " + std::to_string(leaf) + " has two parents";
      has_leaf[leaf] = true;
    }
  }
  if (std::find(is_named.begin(), is_named.end(), false) != is_named.end()) return "a node is not reached";
  return std::find(has_leaf.begin(), has_leaf.end(), false) == has_leaf.end() ? "" : "a leaf is not reached";
}

std::string fault_of_leaves(const Octree& tree, std::size_t primitive_count) {
  if (tree.leaf_first.front() != 0 || tree.leaf_first.back() != tree.references.size()) return "leaves do not hold all references";
  for (std::uint32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
    if (tree.leaf_first[leaf] >= tree.leaf_first[leaf + 1]) return "leaf " + std::to_string(leaf) + " is empty";
    for (std::uint32_t i = tree.leaf_first[leaf]; i < tree.leaf_first[leaf + 1]; ++i) {
      if (i >= tree.references.size() || tree.references[i] >= primitive_count)
        return "reference " + std::to_string(i) + " names a primitive that is not there";
      if (i > tree.leaf_first[leaf] && tree.references[i] <= tree.references[i - 1]) return "the references of a leaf do not ascend";
    }
  }
  return "";
}

// A plane is inside the cell where the axis is cut, and at the upper end, with nothing above it, where it is not.
std::string fault_of_planes(const OctreeNode& node, const Box& cell) {
  for (int axis = 0; axis < 3; ++axis) {
    const bool is_inside = cell.lower[axis] < node.planes[axis] && node.planes[axis] < cell.upper[axis];
    const bool is_cut = (node.cut_axes >> axis & 1U) != 0;
    if (is_cut && !is_inside) return "a plane is not inside its cell";
    if (is_cut) continue;
    if (node.planes[axis] != cell.upper[axis]) return "an axis that is not cut has its plane inside the cell";
    for (unsigned octant = 0; octant < 8; ++octant)
      if ((octant >> axis & 1U) != 0 && ((node.interior_mask | node.leaf_mask) >> octant & 1U) != 0)
        return "there is something above a cell that is not cut";
  }
  return "";
}

}  // namespace

std::string Octree::validate(std::size_t primitive_count) const {
  if (nodes.empty()) return references.empty() && leaf_first.empty() && bounds.is_empty() && depth == 0 ? "" : "an empty tree is not empty";
  if (leaf_first.empty()) return "there are no leaves";
  std::string fault = fault_of_links(*this);
  if (fault.empty()) fault = fault_of_leaves(*this, primitive_count);
  if (!fault.empty()) return fault;
  if (!cell.contains(bounds)) return "the root's cell does not hold everything";

  std::uint32_t deepest = 0;
  visit([&](const Visited& visited) {
    if (!fault.empty()) return;
    deepest = std::max(deepest, visited.is_leaf ? visited.depth : 0);
    if (!visited.is_leaf) fault = fault_of_planes(nodes[visited.node], visited.cell);
  });
  if (!fault.empty()) return fault;
  if (deepest != depth) return "the depth is " + std::to_string(deepest) + ", not " + std::to_string(depth) + " as stated";
  return depth <= kMaxDepth ? "" : "deeper than the traversal stack";
}

}  // namespace grove
