#include "grove/lab/view/view_tree.h"

namespace grove {
namespace {

void put(std::vector<std::uint32_t>& places, std::uint32_t number, std::uint32_t place) {
  if (number >= places.size()) places.resize(std::size_t{number} + number / 2 + 64, ViewNode::kNone);
  places[number] = place;
}

std::uint32_t get(const std::vector<std::uint32_t>& places, std::uint32_t number) {
  return number < places.size() ? places[number] : ViewNode::kNone;
}

}  // namespace

ViewTree::ViewTree(const Scene& scene, const SceneAccelerator& accelerator, std::size_t most_nested_nodes) {
  std::size_t nested = 0;
  if (accelerator.has_top_level())
    for (const Instance& instance : scene.instances) nested += accelerator.objects()[instance.object]->statistics().nodes;
  is_whole_ = nested <= most_nested_nodes;
  nodes_.reserve(accelerator.top().statistics().nodes + (is_whole_ ? nested : 0));
  add(accelerator.top(), Transform(), ViewNode::kNone, &top_);
  if (!accelerator.has_top_level() || !is_whole_ || nodes_.empty()) return;
  objects_.resize(accelerator.objects().size());
  std::vector<bool> is_known(objects_.size(), false);
  instances_.reserve(scene.instances.size());
  for (const Instance& instance : scene.instances) {
    instances_.push_back({instance.object, static_cast<std::uint32_t>(nodes_.size())});
    add(*accelerator.objects()[instance.object], instance.object_to_world, 0,
        is_known[instance.object] ? nullptr : &objects_[instance.object]);
    is_known[instance.object] = true;
  }
}

void ViewTree::add(const Accelerator& accelerator, const Transform& transform, std::uint32_t parent, Places* places) {
  const auto root = static_cast<std::uint32_t>(nodes_.size());
  const std::uint32_t root_depth = parent == ViewNode::kNone ? 0 : nodes_[parent].depth + 1;
  std::vector<std::uint32_t> path;  // the last node of each level
  bool follows_interior = false;
  std::uint32_t last_depth = 0;
  accelerator.visit_nodes([&](const NodeView& view) {
    const auto place = static_cast<std::uint32_t>(nodes_.size());
    // A leaf right after an interior node of the same depth is that node's own references.
    const bool is_own = view.is_leaf && follows_interior && view.depth == last_depth;
    const std::uint32_t depth = view.depth + (is_own ? 1 : 0);
    ViewNode& node = nodes_.emplace_back();
    node.box = transform.is_identity() ? view.box : transform.box(view.box);
    node.planes = view.planes;
    node.depth = root_depth + depth;
    node.cut_axes = transform.is_identity() ? view.cut_axes : 0;
    node.is_leaf = view.is_leaf;
    node.references = view.is_leaf ? view.reference_count : 0;
    node.parent = depth > 0 ? path[depth - 1] : parent;
    if (node.parent != ViewNode::kNone) ++nodes_[node.parent].child_count;
    path.resize(std::size_t{depth} + 1);
    path[depth] = place;
    follows_interior = !view.is_leaf;
    last_depth = view.depth;
    if (places == nullptr) return;
    // Leaves without references may share their number with one that has some.
    if (!view.is_leaf) {
      put(places->interior, view.number, place - root);
    } else if (view.reference_count > 0 || get(places->leaves, view.number) == ViewNode::kNone) {
      put(places->leaves, view.number, place - root);
    }
  });
}

std::uint32_t ViewTree::find(const SceneStep& step) const {
  const Places* places = &top_;
  std::uint32_t root = 0;
  if (step.instance != kInvalidId) {
    if (step.instance >= instances_.size()) return ViewNode::kNone;
    places = &objects_[instances_[step.instance].object];
    root = instances_[step.instance].root;
  }
  const TraversalStep::Kind kind = step.step.kind;
  if (kind == TraversalStep::Kind::test) return ViewNode::kNone;
  const bool is_leaf = kind == TraversalStep::Kind::cell || kind == TraversalStep::Kind::leaf;
  const std::uint32_t place = get(is_leaf ? places->leaves : places->interior, step.step.number);
  return place == ViewNode::kNone ? place : root + place;
}

void ViewTree::count(std::span<const SceneStep> steps) {
  std::uint32_t at = ViewNode::kNone;
  std::uint32_t top_leaf = ViewNode::kNone;
  bool was_come_to = false;  // a leaf that is entered after its cell was come to is visited once
  for (const SceneStep& step : steps) {
    if (step.step.kind == TraversalStep::Kind::test) {
      // After steps in an object the top structure is where it was.
      const std::uint32_t tested_in = step.instance == kInvalidId ? top_leaf : at;
      if (tested_in != ViewNode::kNone) ++nodes_[tested_in].tests;
      continue;
    }
    if (step.step.kind == TraversalStep::Kind::gap) continue;
    const std::uint32_t place = find(step);
    const bool is_same = was_come_to && place == at && step.step.kind == TraversalStep::Kind::leaf;
    if (place != ViewNode::kNone && !is_same) ++nodes_[place].visits;
    was_come_to = step.step.kind == TraversalStep::Kind::cell;
    at = place;
    if (step.instance == kInvalidId) top_leaf = place;
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
