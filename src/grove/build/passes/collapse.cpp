#include "grove/build/passes/collapse.h"

#include <algorithm>
#include <limits>

#include "grove/base/parallel.h"
#include "grove/build/passes/leaf_writer.h"

namespace grove {
namespace {

// Subtrees of fewer nodes are planned by one task.
constexpr std::uint32_t kTaskSize = 16384;

float half_area(float x, float y, float z) {
  return x * (y + z) + y * z;
}

Box slot_box(const Bvh2& bvh, std::uint32_t slot) {
  return bvh.nodes[slot / 2].child_box(static_cast<int>(slot % 2));
}

void clear(Bvh2Node& /*node*/) {}

template <int kWidth>
void clear(WideNode<kWidth>& node) {
  for (int i = 0; i < kWidth; ++i) node.set_child(i, Box(), {0, 0});
}

// Emits a planned hierarchy in depth-first order. `Output` has nodes, references, bounds and depth; set_child(node, i, box, first, count)
// fills a place.
template <typename Output, typename SetChild>
void emit(const Bvh2& bvh, const CollapsePlan& plan, Output& output, const SetChild& set_child) {
  output.bounds = bvh.bounds;
  LeafWriter leaves(bvh.references, output.references);
  const CollapsePlan::Child root = plan.root();
  if (root.count > 0) {
    leaves.write(root.first, root.count);
    return;
  }
  // Where the number of a node that has been emitted is to be written, with its depth.
  struct Pending {
    CollapsePlan::Child child;
    std::uint32_t parent;
    int place;
    std::uint32_t depth;
  };
  std::vector<Pending> stack{{root, CollapsePlan::kNoNode, 0, 0}};
  while (!stack.empty()) {
    const Pending top = stack.back();
    stack.pop_back();
    output.depth = std::max(output.depth, top.depth);
    if (top.child.count > 0) {
      const auto [first, count] = leaves.write(top.child.first, top.child.count);
      set_child(output.nodes[top.parent], top.place, slot_box(bvh, top.child.slot), first, count);
      continue;
    }
    const auto number = static_cast<std::uint32_t>(output.nodes.size());
    clear(output.nodes.emplace_back());
    if (top.parent != CollapsePlan::kNoNode) set_child(output.nodes[top.parent], top.place, slot_box(bvh, top.child.slot), number, 0U);
    CollapsePlan::Child children[CollapsePlan::kMaxArity];
    const int count = plan.children(top.child.node, children);
    for (int i = count - 1; i >= 0; --i) stack.push_back({children[i], number, i, top.depth + 1});
  }
}

}  // namespace

SlotAreas box_areas(const Bvh2& bvh) {
  const AreaMeasure measure(bvh.bounds);
  SlotAreas areas;
  areas.root = static_cast<float>(measure.half_area(bvh.bounds));
  areas.slots.resize(2 * bvh.nodes.size());
  parallel_for(bvh.nodes.size(), 4096, [&](std::size_t i) {
    for (int side = 0; side < 2; ++side)
      areas.slots[2 * i + static_cast<std::size_t>(side)] = static_cast<float>(measure.half_area(bvh.nodes[i].child_box(side)));
  });
  return areas;
}

CollapsePlan::CollapsePlan(const Bvh2& bvh, const CollapseSettings& settings)
    : bvh_(bvh), settings_(settings), area_scale_(AreaMeasure(bvh.bounds).scale()) {
  plan();
}

CollapsePlan::CollapsePlan(const Bvh2& bvh, std::span<const float> slot_areas, float root_area, const CollapseSettings& settings)
    : bvh_(bvh), slot_areas_(slot_areas), settings_(settings), area_scale_(1.0F) {
  if (bvh.nodes.empty()) return;
  areas_.resize(bvh.nodes.size());
  areas_[0] = root_area;
  parallel_for(bvh.nodes.size(), 4096, [&](std::size_t i) {
    for (std::size_t side = 0; side < 2; ++side)
      if (bvh.nodes[i].child[side].count == 0) areas_[bvh.nodes[i].child[side].first] = slot_areas[2 * i + side];
  });
  plan();
}

void CollapsePlan::plan() {
  if (bvh_.nodes.empty()) return;
  if (settings_.widening == Widening::greedy) return list_ranges();
  choices_.resize(bvh_.nodes.size());
  plan_range(0, static_cast<std::uint32_t>(bvh_.nodes.size()));
}

// Plans the subtree of node `first`, whose nodes end before `last`.
LeastForests CollapsePlan::plan_range(std::uint32_t first, std::uint32_t last) {
  if (last - first <= kTaskSize) return plan_small_range(first, last);
  const Bvh2Node& node = bvh_.nodes[first];
  LeastForests left;
  LeastForests right;
  const std::uint32_t middle = node.child[1].count > 0 ? last : node.child[1].first;
  const auto plan_left = [&] { left = node.child[0].count > 0 ? forests_of_leaf(2 * first) : plan_range(first + 1, middle); };
  const auto plan_right = [&] { right = node.child[1].count > 0 ? forests_of_leaf(2 * first + 1) : plan_range(middle, last); };
  parallel_invoke(plan_left, plan_right);
  plan_node(first, &left, &right, left);
  return left;
}

// Backwards, so that subtrees come before what they are in; those that wait for it are on a stack, the left of two on top.
LeastForests CollapsePlan::plan_small_range(std::uint32_t first, std::uint32_t last) {
  LeastForests waiting[Bvh2::kMaxDepth + 2];
  LeastForests leaves[2];
  std::size_t count = 0;
  for (std::uint32_t node = last; node-- > first;) {
    const LeastForests* sides[2];
    for (std::uint32_t side = 0; side < 2; ++side) {
      if (bvh_.nodes[node].child[side].count > 0) {
        leaves[side].set_leaf(slot_area(2 * node + side), bvh_.nodes[node].child[side].count, settings_);
        sides[side] = &leaves[side];
      } else {
        sides[side] = &waiting[--count];
      }
    }
    plan_node(node, sides[0], sides[1], waiting[count]);
    ++count;
  }
  return waiting[0];
}

void CollapsePlan::plan_node(std::uint32_t node, const LeastForests* left, const LeastForests* right, LeastForests& both) {
  choices_[node] = both.join(*left, *right, node_area(node), settings_);
}

LeastForests CollapsePlan::forests_of_leaf(std::uint32_t slot) const {
  LeastForests forests;
  forests.set_leaf(slot_area(slot), bvh_.nodes[slot / 2].child[slot % 2].count, settings_);
  return forests;
}

float CollapsePlan::slot_area(std::uint32_t slot) const {
  if (!slot_areas_.empty()) return slot_areas_[slot];
  const auto& planes = bvh_.nodes[slot / 2].planes;
  const std::uint32_t side = slot % 2;
  return half_area((planes[0][side + 2] - planes[0][side]) * area_scale_, (planes[1][side + 2] - planes[1][side]) * area_scale_,
                   (planes[2][side + 2] - planes[2][side]) * area_scale_);
}

float CollapsePlan::node_area(std::uint32_t node) const {
  if (!areas_.empty()) return areas_[node];
  const auto& planes = bvh_.nodes[node].planes;
  const auto extent = [&](int axis) {
    return (std::max(planes[axis][2], planes[axis][3]) - std::min(planes[axis][0], planes[axis][1])) * area_scale_;
  };
  return half_area(extent(0), extent(1), extent(2));
}

void CollapsePlan::list_ranges() {
  ranges_.resize(bvh_.nodes.size());
  for (std::size_t node = ranges_.size(); node-- > 0;) {
    const auto range = [&](const Bvh2Node::Child& child) {
      return child.count > 0 ? Range{child.first, child.count} : ranges_[child.first];
    };
    const Range left = range(bvh_.nodes[node].child[0]);
    ranges_[node] = {left.first, left.count + range(bvh_.nodes[node].child[1]).count};
  }
}

// The references of a node, which stand in one piece.
CollapsePlan::Range CollapsePlan::range_of(std::uint32_t node) const {
  if (!ranges_.empty()) return ranges_[node];
  Bvh2Node::Child first = bvh_.nodes[node].child[0];
  Bvh2Node::Child last = bvh_.nodes[node].child[1];
  while (first.count == 0) first = bvh_.nodes[first.first].child[0];
  while (last.count == 0) last = bvh_.nodes[last.first].child[1];
  return {first.first, last.first + last.count - first.first};
}

CollapsePlan::Child CollapsePlan::child_of(std::uint32_t slot) const {
  const Bvh2Node::Child& link = bvh_.nodes[slot / 2].child[slot % 2];
  if (link.count > 0) return {slot, kNoNode, link.first, link.count};
  if (is_leaf(link.first)) {
    const Range range = range_of(link.first);
    return {slot, link.first, range.first, range.count};
  }
  return {slot, link.first, 0, 0};
}

CollapsePlan::Child CollapsePlan::root() const {
  if (bvh_.nodes.empty()) return {kRootSlot, kNoNode, 0, static_cast<std::uint32_t>(bvh_.references.size())};
  if (is_leaf(0)) return {kRootSlot, 0, 0, range_of(0).count};
  return {kRootSlot, 0, 0, 0};
}

void CollapsePlan::collect(std::uint32_t slot, int roots, Child* children, int& count) const {
  const Bvh2Node::Child& link = bvh_.nodes[slot / 2].child[slot % 2];
  if (link.count == 0) {
    const ForestChoices choices = choices_[link.first];
    while (roots > 1 && choices.of_roots(roots) == 0) --roots;
    if (roots > 1) {
      const auto from_left = static_cast<int>(choices.of_roots(roots));
      collect(2 * link.first, from_left, children, count);
      collect(2 * link.first + 1, roots - from_left, children, count);
      return;
    }
  }
  children[count++] = child_of(slot);
}

int CollapsePlan::children(std::uint32_t node, Child* children) const {
  int count = 0;
  if (settings_.widening == Widening::greedy) {
    std::uint32_t slots[kMaxArity];
    count = open_greedily(node, slots);
    for (int i = 0; i < count; ++i) children[i] = child_of(slots[i]);
    return count;
  }
  const auto from_left = static_cast<int>(choices_[node].of_roots(1));
  collect(2 * node, from_left, children, count);
  collect(2 * node + 1, settings_.arity - from_left, children, count);
  return count;
}

bool CollapsePlan::is_leaf(std::uint32_t node) const {
  if (settings_.widening == Widening::optimal) return choices_[node].of_roots(1) == 0;
  if (ranges_[node].count > settings_.leaf_size) return false;
  std::uint32_t slots[kMaxArity];
  const int count = open_greedily(node, slots);
  float split = node_area(node) * static_cast<float>(settings_.cost.traversal);
  for (int i = 0; i < count; ++i) split += subset_cost(slots[i]);
  return node_area(node) * settings_.leaf_time(ranges_[node].count) <= split;
}

float CollapsePlan::subset_cost(std::uint32_t slot) const {
  const Bvh2Node::Child& link = bvh_.nodes[slot / 2].child[slot % 2];
  const std::uint32_t count = link.count > 0 ? link.count : ranges_[link.first].count;
  return slot_area(slot) * settings_.leaf_time(count);
}

int CollapsePlan::open_greedily(std::uint32_t node, std::uint32_t* slots) const {
  slots[0] = 2 * node;
  slots[1] = 2 * node + 1;
  int count = 2;
  while (count < settings_.arity) {
    int best = -1;
    float most_saved = -std::numeric_limits<float>::infinity();
    for (int i = 0; i < count; ++i) {
      const Bvh2Node::Child& link = bvh_.nodes[slots[i] / 2].child[slots[i] % 2];
      if (link.count > 0) continue;
      const float saved = subset_cost(slots[i]) - subset_cost(2 * link.first) - subset_cost(2 * link.first + 1);
      if (saved > most_saved) {
        most_saved = saved;
        best = i;
      }
    }
    if (best < 0) break;
    const std::uint32_t opened = bvh_.nodes[slots[best] / 2].child[slots[best] % 2].first;
    std::copy_backward(slots + best + 1, slots + count, slots + count + 1);
    slots[best] = 2 * opened;
    slots[best + 1] = 2 * opened + 1;
    ++count;
  }
  return count;
}

Bvh2 collapse_leaves(const Bvh2& bvh, const CollapseSettings& settings) {
  Bvh2 collapsed;
  if (bvh.references.empty()) return collapsed;
  CollapseSettings binary = settings;
  binary.arity = 2;
  binary.widening = Widening::optimal;
  const CollapsePlan plan(bvh, binary);
  collapsed.nodes.reserve(bvh.nodes.size() / 2);
  emit(bvh, plan, collapsed, [](Bvh2Node& node, int i, const Box& box, std::uint32_t first, std::uint32_t count) {
    for (int axis = 0; axis < 3; ++axis) {
      node.planes[axis][i] = box.lower[axis];
      node.planes[axis][i + 2] = box.upper[axis];
    }
    node.child[i] = {first, count};
  });
  return collapsed;
}

template <int kWidth>
WideBvh<kWidth> widen(const Bvh2& bvh, const CollapseSettings& settings) {
  WideBvh<kWidth> wide;
  if (bvh.references.empty()) return wide;
  CollapseSettings of_arity = settings;
  of_arity.arity = kWidth;
  const CollapsePlan plan(bvh, of_arity);
  wide.nodes.reserve(bvh.nodes.size() / static_cast<std::size_t>(kWidth));
  emit(bvh, plan, wide, [](WideNode<kWidth>& node, int i, const Box& box, std::uint32_t first, std::uint32_t count) {
    node.set_child(i, box, {first, count});
  });
  return wide;
}

template WideBvh<4> widen<4>(const Bvh2& bvh, const CollapseSettings& settings);
template WideBvh<8> widen<8>(const Bvh2& bvh, const CollapseSettings& settings);

}  // namespace grove
