#include "grove/build/passes/collapse.h"

#include <algorithm>
#include <limits>

#include "grove/base/parallel.h"
#include "grove/build/passes/leaf_writer.h"

namespace grove {
namespace {

// Subtrees of fewer nodes are planned by one task.
constexpr std::uint32_t kTaskSize = 16384;

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

CollapsePlan::CollapsePlan(const Bvh2& bvh, std::span<const float> slot_areas, float root_area, const CollapseSettings& settings)
    : bvh_(bvh), slot_areas_(slot_areas), settings_(settings) {
  if (bvh.nodes.empty()) return;
  forests_.resize(bvh.nodes.size());
  ranges_.resize(bvh.nodes.size());
  areas_.resize(bvh.nodes.size());
  areas_[0] = root_area;
  parallel_for(bvh.nodes.size(), 4096, [&](std::size_t i) {
    for (std::size_t side = 0; side < 2; ++side)
      if (bvh.nodes[i].child[side].count == 0) areas_[bvh.nodes[i].child[side].first] = slot_areas[2 * i + side];
  });
  plan_range(0, static_cast<std::uint32_t>(bvh.nodes.size()));
}

// Plans the subtree of node `first`, whose nodes end before `last`.
void CollapsePlan::plan_range(std::uint32_t first, std::uint32_t last) {
  const Bvh2Node& node = bvh_.nodes[first];
  if (last - first <= kTaskSize || node.child[0].count > 0 || node.child[1].count > 0) {
    if (last - first > kTaskSize) {
      // One child is a leaf: the other is the rest.
      plan_range(first + 1, last);
      plan_node(first);
      return;
    }
    for (std::uint32_t i = last; i-- > first;) plan_node(i);
    return;
  }
  parallel_invoke([&] { plan_range(node.child[0].first, node.child[1].first); }, [&] { plan_range(node.child[1].first, last); });
  plan_node(first);
}

float CollapsePlan::forest_cost(std::uint32_t slot, int roots) const {
  const Bvh2Node::Child& child = bvh_.nodes[slot / 2].child[slot % 2];
  if (child.count > 0) return slot_areas_[slot] * settings_.leaf_time(child.count);
  return forests_[child.first].cost[roots - 1];
}

void CollapsePlan::plan_node(std::uint32_t node) {
  const Bvh2Node& binary = bvh_.nodes[node];
  const Range sides[2] = {binary.child[0].count > 0 ? Range{binary.child[0].first, binary.child[0].count} : ranges_[binary.child[0].first],
                          binary.child[1].count > 0 ? Range{binary.child[1].first, binary.child[1].count} : ranges_[binary.child[1].first]};
  ranges_[node] = {sides[0].first, sides[0].count + sides[1].count};
  if (settings_.widening == Widening::greedy) return;  // decided from the top
  Forests& forests = forests_[node];
  const int arity = settings_.arity;
  float left[kMaxArity];
  float right[kMaxArity];
  for (int roots = 1; roots < arity; ++roots) {
    left[roots] = forest_cost(2 * node, roots);
    right[roots] = forest_cost(2 * node + 1, roots);
  }
  const auto distribute = [&](int roots, std::uint8_t& choice) {
    float best = std::numeric_limits<float>::infinity();
    for (int k = 1; k < roots; ++k) {
      if (left[k] + right[roots - k] < best) {
        best = left[k] + right[roots - k];
        choice = static_cast<std::uint8_t>(k);
      }
    }
    return best;
  };
  std::uint8_t choice = 1;
  const float interior = areas_[node] * static_cast<float>(settings_.cost.traversal) + distribute(arity, choice);
  const float leaf = ranges_[node].count <= settings_.leaf_size ? areas_[node] * settings_.leaf_time(ranges_[node].count)
                                                                : std::numeric_limits<float>::infinity();
  const bool is_leaf = leaf <= interior;
  forests.choice[0] = is_leaf ? 0 : choice;
  forests.cost[0] = is_leaf ? leaf : interior;
  for (int roots = 2; roots < arity; ++roots) {
    const float cost = distribute(roots, choice);
    const bool is_better = cost < forests.cost[roots - 2];
    forests.choice[roots - 1] = is_better ? choice : 0;
    forests.cost[roots - 1] = is_better ? cost : forests.cost[roots - 2];
  }
}

CollapsePlan::Child CollapsePlan::child_of(std::uint32_t slot) const {
  const Bvh2Node::Child& link = bvh_.nodes[slot / 2].child[slot % 2];
  if (link.count > 0) return {slot, kNoNode, link.first, link.count};
  if (is_leaf(link.first)) return {slot, link.first, ranges_[link.first].first, ranges_[link.first].count};
  return {slot, link.first, 0, 0};
}

CollapsePlan::Child CollapsePlan::root() const {
  if (bvh_.nodes.empty()) return {kRootSlot, kNoNode, 0, static_cast<std::uint32_t>(bvh_.references.size())};
  if (is_leaf(0)) return {kRootSlot, 0, 0, ranges_[0].count};
  return {kRootSlot, 0, 0, 0};
}

void CollapsePlan::collect(std::uint32_t slot, int roots, Child* children, int& count) const {
  const Bvh2Node::Child& link = bvh_.nodes[slot / 2].child[slot % 2];
  if (link.count == 0) {
    const Forests& forests = forests_[link.first];
    while (roots > 1 && forests.choice[roots - 1] == 0) --roots;
    if (roots > 1) {
      const int from_left = forests.choice[roots - 1];
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
  const int from_left = forests_[node].choice[0];
  collect(2 * node, from_left, children, count);
  collect(2 * node + 1, settings_.arity - from_left, children, count);
  return count;
}

bool CollapsePlan::is_leaf(std::uint32_t node) const {
  if (settings_.widening == Widening::optimal) return forests_[node].choice[0] == 0;
  if (ranges_[node].count > settings_.leaf_size) return false;
  std::uint32_t slots[kMaxArity];
  const int count = open_greedily(node, slots);
  float split = areas_[node] * static_cast<float>(settings_.cost.traversal);
  for (int i = 0; i < count; ++i) split += subset_cost(slots[i]);
  return areas_[node] * settings_.leaf_time(ranges_[node].count) <= split;
}

float CollapsePlan::subset_cost(std::uint32_t slot) const {
  const Bvh2Node::Child& link = bvh_.nodes[slot / 2].child[slot % 2];
  const std::uint32_t count = link.count > 0 ? link.count : ranges_[link.first].count;
  return slot_areas_[slot] * settings_.leaf_time(count);
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
  const SlotAreas areas = box_areas(bvh);
  const CollapsePlan plan(bvh, areas.slots, areas.root, binary);
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
  const SlotAreas areas = box_areas(bvh);
  const CollapsePlan plan(bvh, areas.slots, areas.root, of_arity);
  wide.nodes.reserve(bvh.nodes.size() / static_cast<std::size_t>(kWidth));
  emit(bvh, plan, wide, [](WideNode<kWidth>& node, int i, const Box& box, std::uint32_t first, std::uint32_t count) {
    node.set_child(i, box, {first, count});
  });
  return wide;
}

template WideBvh<4> widen<4>(const Bvh2& bvh, const CollapseSettings& settings);
template WideBvh<8> widen<8>(const Bvh2& bvh, const CollapseSettings& settings);

}  // namespace grove
