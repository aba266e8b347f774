#include "grove/lab/view/view_tree.h"

namespace grove {
namespace {

void put(std::vector<std::uint32_t>& places, std::uint32_t number, std::uint32_t place) {
  if (number >= places.size()) places.resize(std::size_t{number} + number / 2 + 64, ViewNode::kNone);
  places[number] = place;
}

}  // namespace

ViewTree::ViewTree(const Accelerator& accelerator) {
  nodes_.reserve(accelerator.statistics().nodes);
  std::vector<std::uint32_t> path;  // the last node of each level
  bool follows_interior = false;
  std::uint32_t last_depth = 0;
  accelerator.visit_nodes([&](const NodeView& view) {
    const auto place = static_cast<std::uint32_t>(nodes_.size());
    // A leaf right after an interior node of the same depth is that node's own references.
    const bool is_own = view.is_leaf && follows_interior && view.depth == last_depth;
    const std::uint32_t depth = view.depth + (is_own ? 1 : 0);
    ViewNode& node = nodes_.emplace_back();
    node.box = view.box;
    node.planes = view.planes;
    node.depth = depth;
    node.cut_axes = view.cut_axes;
    node.is_leaf = view.is_leaf;
    node.references = view.is_leaf ? view.reference_count : 0;
    if (depth > 0) {
      node.parent = path[depth - 1];
      ++nodes_[node.parent].child_count;
    }
    path.resize(std::size_t{depth} + 1);
    path[depth] = place;
    // Leaves without references may share their number with one that has some.
    if (!view.is_leaf) {
      put(interior_, view.number, place);
    } else if (view.reference_count > 0 || view.number >= leaves_.size() || leaves_[view.number] == ViewNode::kNone) {
      put(leaves_, view.number, place);
    }
    follows_interior = !view.is_leaf;
    last_depth = view.depth;
  });
}

std::uint32_t ViewTree::find(const TraversalStep& step) const {
  switch (step.kind) {
    case TraversalStep::Kind::node:
    case TraversalStep::Kind::gap:
      return step.number < interior_.size() ? interior_[step.number] : ViewNode::kNone;
    case TraversalStep::Kind::cell:
    case TraversalStep::Kind::leaf:
      return step.number < leaves_.size() ? leaves_[step.number] : ViewNode::kNone;
    case TraversalStep::Kind::test:
      break;
  }
  return ViewNode::kNone;
}

void ViewTree::count(std::span<const TraversalStep> steps) {
  std::uint32_t at = ViewNode::kNone;
  bool was_come_to = false;  // a leaf that is entered after its cell was come to is visited once
  for (const TraversalStep& step : steps) {
    if (step.kind == TraversalStep::Kind::test) {
      if (at != ViewNode::kNone) ++nodes_[at].tests;
      continue;
    }
    if (step.kind == TraversalStep::Kind::gap) continue;
    const std::uint32_t place = find(step);
    const bool is_same = was_come_to && place == at && step.kind == TraversalStep::Kind::leaf;
    if (place != ViewNode::kNone && !is_same) ++nodes_[place].visits;
    was_come_to = step.kind == TraversalStep::Kind::cell;
    at = place;
  }
}

void ViewTree::sum_up() {
  for (std::size_t i = nodes_.size(); i-- > 1;) {
    ViewNode& parent = nodes_[nodes_[i].parent];
    parent.references += nodes_[i].references;
    parent.tests += nodes_[i].tests;
  }
}

}  // namespace grove
