#include "grove/accel/octree.h"

#include <algorithm>

namespace grove {
namespace {

// What a node says of its children and leaves, which must be the next: numbers are depth first.
class LinkCheck {
 public:
  explicit LinkCheck(const Octree& tree) : tree_(tree) {}

  // The first fault of a node in words, or an empty string; to be called in the order of Octree::visit.
  std::string next(std::uint32_t number) {
    const OctreeNode& node = tree_.nodes[number];
    const std::string name = "node " + std::to_string(number);
    if ((node.interior_mask & node.leaf_mask) != 0 || node.has_own > 1 || node.cut_axes > 7) return name + " has an octant of two kinds";
    const std::uint32_t children = count_octants(node.interior_mask);
    if (children == 0 && node.leaf_count() == 0) return name + " has nothing in it";
    if (node.first_child != next_node_) return name + " names a child that is not the next";
    if (node.first_leaf != next_leaf_) return name + " names a leaf that is not the next";
    next_node_ += children;
    next_leaf_ += node.leaf_count();
    if (next_node_ > tree_.nodes.size() || next_leaf_ > tree_.leaf_count()) return name + " names a child or leaf that is not there";
    return "";
  }
  [[nodiscard]] bool is_complete() const { return next_node_ == tree_.nodes.size() && next_leaf_ == tree_.leaf_count(); }

 private:
  const Octree& tree_;
  std::size_t next_node_ = 1;
  std::size_t next_leaf_ = 0;
};

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
  std::string fault = fault_of_leaves(*this, primitive_count);
  if (!fault.empty()) return fault;
  if (!cell.contains(bounds)) return "the root's cell does not hold everything";

  std::uint32_t deepest = 0;
  LinkCheck links(*this);
  // Checked before their children are looked at, so that the visit cannot run astray.
  const auto check = [&](const Visited& visited) {
    if (visited.is_leaf) deepest = std::max(deepest, visited.depth);
    if (visited.is_leaf) return true;
    fault = links.next(visited.node);
    if (fault.empty()) fault = fault_of_planes(nodes[visited.node], visited.cell);
    return fault.empty();
  };
  visit(check);
  if (!fault.empty()) return fault;
  if (!links.is_complete()) return "a node or leaf is not reached";
  if (deepest != depth) return "the depth is " + std::to_string(deepest) + ", not " + std::to_string(depth) + " as stated";
  return depth <= kMaxDepth ? "" : "deeper than the traversal stack";
}

}  // namespace grove
