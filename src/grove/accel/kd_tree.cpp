#include "grove/accel/kd_tree.h"

#include <algorithm>

namespace grove {
namespace {

// Goes through a tree that may be faulty: no further than it can be trusted.
class Inspection {
 public:
  Inspection(const KdTree& tree, std::size_t primitive_count)
      : tree_(tree),
        primitive_count_(primitive_count),
        is_reached_(tree.nodes.size() / 2, false),
        is_in_leaf_(tree.references.size(), false) {}

  std::string run() {
    is_reached_[0] = true;
    look_at(0, tree_.bounds, 0);
    if (!fault_.empty()) return fault_;
    for (std::size_t i = 2; i < tree_.nodes.size(); ++i)
      if (!is_reached_[i / 2] && tree_.nodes[i] != KdNode::leaf(0, 0))
        return "node " + std::to_string(i) + " is not reached, and not empty";
    if (deepest_ != tree_.depth) return "the depth is " + std::to_string(deepest_) + ", not " + std::to_string(tree_.depth) + " as stated";
    return "";
  }

 private:
  void look_at(std::uint32_t number, const Box& cell, std::uint32_t depth) {
    if (!fault_.empty()) return;
    deepest_ = std::max(deepest_, depth);
    const KdNode node = tree_.nodes[number];
    if (node.is_leaf()) {
      look_at_leaf(node);
      return;
    }
    const int axis = static_cast<int>(node.axis());
    const std::uint32_t child = node.lower_child();
    if (!(cell.lower[axis] < node.plane() && node.plane() < cell.upper[axis])) {
      fault_ = "a plane is not inside its cell";
    } else if (child % 2 != 0 || child + 1 >= tree_.nodes.size()) {
      fault_ = "node " + std::to_string(number) + " names a child that cannot be";
    } else if (is_reached_[child / 2]) {
      fault_ = "the pair at " + std::to_string(child) + " has two parents";
    } else if (depth == KdTree::kMaxDepth) {
      fault_ = "deeper than the traversal stack";
    }
    if (!fault_.empty()) return;
    is_reached_[child / 2] = true;
    for (std::uint32_t side = 0; side < 2; ++side) {
      Box child_cell = cell;
      (side == 0 ? child_cell.upper : child_cell.lower)[axis] = node.plane();
      look_at(child + side, child_cell, depth + 1);
    }
  }

  void look_at_leaf(const KdNode& leaf) {
    if (leaf.count() > 0 && leaf.first() + std::size_t{leaf.count()} > tree_.references.size()) {
      fault_ = "a leaf reaches past the references";
      return;
    }
    for (std::uint32_t i = leaf.first(); i < leaf.first() + leaf.count(); ++i) {
      if (is_in_leaf_[i]) fault_ = "reference " + std::to_string(i) + " is in two leaves";
      is_in_leaf_[i] = true;
      if (tree_.references[i] >= primitive_count_) fault_ = "reference " + std::to_string(i) + " names a primitive that is not there";
      if (i > leaf.first() && tree_.references[i] <= tree_.references[i - 1]) fault_ = "the references of a leaf do not ascend";
    }
  }

  const KdTree& tree_;
  std::size_t primitive_count_;
  std::vector<bool> is_reached_;  // by pair
  std::vector<bool> is_in_leaf_;  // by reference
  std::uint32_t deepest_ = 0;
  std::string fault_;
};

}  // namespace

std::string KdTree::validate(std::size_t primitive_count) const {
  if (nodes.empty()) return references.empty() && bounds.is_empty() && depth == 0 ? "" : "an empty tree has references, bounds or depth";
  if (nodes.size() % 2 != 0 || nodes.size() > kMaxNodes) return "nodes do not come in pairs, or are too many";
  return Inspection(*this, primitive_count).run();
}

bool KdTree::is_compact() const {
  std::size_t next_pair = 2;
  std::size_t next_reference = 0;
  bool in_order = true;
  visit([&](const Box& /*cell*/, std::uint32_t /*depth*/, const KdNode& node) {
    if (node.is_leaf()) {
      in_order = in_order && node.first() == next_reference;
      next_reference += node.count();
    } else {
      in_order = in_order && node.lower_child() == next_pair;
      next_pair += 2;
    }
  });
  return in_order && (nodes.empty() || next_pair == nodes.size()) && next_reference == references.size();
}

}  // namespace grove
