#include "grove/build/kd_tree/kd_tree_editor.h"

#include <algorithm>
#include <utility>

#include "grove/base/check.h"
#include "grove/build/kd_tree/kd_cell.h"

namespace grove {
namespace {

Box4 bounds_of(const KdTree& tree) {
  return {to_float4(tree.bounds.lower), to_float4(tree.bounds.upper)};
}

Box4 child_cell(const Box4& cell, const KdNode& node, int side) {
  return KdCell::child_box(cell, side, static_cast<int>(node.axis()), node.plane());
}

}  // namespace

void KdTreeEditor::study(const KdTree& tree, const KdCostContext& costs) {
  costs_ = costs;
  records_.assign(tree.nodes.size(), {});
  free_pairs_.clear();
  changed_slots_.clear();
  leaves_at_ = {};
  measure(tree, 0, bounds_of(tree), 0, Takes::cost_as_built);
  reference_count_ = records_[0].references;
}

void KdTreeEditor::measure_again(const KdTree& tree, const KdCostContext& costs) {
  costs_ = costs;
  leaves_at_ = {};
  measure(tree, 0, bounds_of(tree), 0, Takes::cost);
}

void KdTreeEditor::measure(const KdTree& tree, std::uint32_t node, const Box4& cell, std::uint32_t depth, Takes takes) {
  const KdNode here = tree.nodes[node];
  if (here.is_leaf()) {
    ++leaves_at_[depth];
    records_[node].cost = cost_of_leaf(cell, here.count());
    records_[node].references = here.count();
  } else {
    for (int side = 0; side < 2; ++side)
      measure(tree, here.lower_child() + static_cast<std::uint32_t>(side), child_cell(cell, here, side), depth + 1, takes);
    sum_up(tree, node, cell);
  }
  if (takes == Takes::cost_as_built) set_built(node, cell);
}

void KdTreeEditor::set_built(std::uint32_t node, const Box4& cell) {
  const float measure = costs_.measure(cell);
  records_[node].built = measure > 0.0F ? records_[node].cost / measure : 0.0F;
  records_[node].changes = 0;
}

void KdTreeEditor::sum_up(const KdTree& tree, std::uint32_t node, const Box4& cell) {
  const KdNodeRecord& lower = records_[tree.nodes[node].lower_child()];
  const KdNodeRecord& upper = records_[tree.nodes[node].lower_child() + 1];
  records_[node].cost = costs_.measure(cell) * static_cast<float>(costs_.model.traversal) + lower.cost + upper.cost;
  records_[node].references = lower.references + upper.references;
}

// Forgets the subtree of a node, which is then an empty leaf that is not counted.
void KdTreeEditor::release(KdTree& tree, std::uint32_t node, std::uint32_t depth) {
  const KdNode here = tree.nodes[node];
  tree.nodes[node] = KdNode::leaf(0, 0);
  if (here.is_leaf()) {
    --leaves_at_[depth];
    reference_count_ -= here.count();
    return;
  }
  release(tree, here.lower_child(), depth + 1);
  release(tree, here.lower_child() + 1, depth + 1);
  free_pairs_.push_back(here.lower_child());
}

std::uint32_t KdTreeEditor::allocate_pair(KdTree& tree) {
  if (!free_pairs_.empty()) {
    const std::uint32_t pair = free_pairs_.back();
    free_pairs_.pop_back();
    return pair;
  }
  GROVE_CHECK(tree.nodes.size() + 2 <= KdTree::kMaxNodes);
  const auto pair = static_cast<std::uint32_t>(tree.nodes.size());
  tree.nodes.resize(pair + 2, KdNode::leaf(0, 0));
  records_.resize(pair + 2);
  return pair;
}

void KdTreeEditor::place_leaf(KdTree& tree, std::uint32_t node, const Box4& cell, std::uint32_t depth, std::uint32_t first,
                              std::span<const std::uint32_t> ids) {
  const auto count = static_cast<std::uint32_t>(ids.size());
  if (first == tree.references.size()) {
    GROVE_CHECK(tree.references.size() + ids.size() < 0xffffffffU);
    tree.references.resize(tree.references.size() + ids.size());
  }
  std::copy(ids.begin(), ids.end(), tree.references.begin() + static_cast<std::ptrdiff_t>(first));
  tree.nodes[node] = KdNode::leaf(first, count);
  if (count > 0) changed_slots_.push_back({first, count});
  ++leaves_at_[depth];
  reference_count_ += count;
  records_[node].cost = cost_of_leaf(cell, count);
  records_[node].references = count;
}

void KdTreeEditor::make_leaf(KdTree& tree, std::uint32_t node, const Box4& cell, std::uint32_t depth, std::span<const std::uint32_t> ids) {
  const KdNode here = tree.nodes[node];
  release(tree, node, depth);
  // Where there is room the references stay where they are.
  const bool fits = here.is_leaf() && ids.size() <= here.count();
  place_leaf(tree, node, cell, depth, fits ? here.first() : static_cast<std::uint32_t>(tree.references.size()), ids);
}

void KdTreeEditor::replace(KdTree& tree, std::uint32_t node, const Box4& cell, std::uint32_t depth, const KdTreePart& part) {
  release(tree, node, depth);
  place(tree, part, node, cell, depth);
}

void KdTreeEditor::place(KdTree& tree, const KdTreePart& part, std::uint32_t node, const Box4& cell, std::uint32_t depth) {
  if (!part.is_joined()) {
    place_node(tree, part, 0, node, cell, depth);
    return;
  }
  const KdNode joint = KdNode::interior(part.axis, part.position, allocate_pair(tree));
  tree.nodes[node] = joint;
  for (int side = 0; side < 2; ++side)
    place(tree, *part.children[side], joint.lower_child() + static_cast<std::uint32_t>(side), child_cell(cell, joint, side), depth + 1);
  sum_up(tree, node, cell);
  set_built(node, cell);
}

void KdTreeEditor::place_node(KdTree& tree, const KdTreePart& part, std::uint32_t from, std::uint32_t node, const Box4& cell,
                              std::uint32_t depth) {
  const KdNode source = part.nodes[from];
  if (source.is_leaf()) {
    place_leaf(tree, node, cell, depth, static_cast<std::uint32_t>(tree.references.size()),
               {part.references.data() + source.first(), source.count()});
  } else {
    const KdNode copy = KdNode::interior(static_cast<int>(source.axis()), source.plane(), allocate_pair(tree));
    tree.nodes[node] = copy;
    for (std::uint32_t side = 0; side < 2; ++side)
      place_node(tree, part, source.lower_child() + side, copy.lower_child() + side, child_cell(cell, copy, static_cast<int>(side)),
                 depth + 1);
    sum_up(tree, node, cell);
  }
  set_built(node, cell);
}

/// Copies a tree and its records in depth-first order.
class KdTreeEditor::Copy {
 public:
  Copy(const KdTree& tree, const std::vector<KdNodeRecord>& from_records, std::size_t node_count, std::size_t reference_count)
      : from_(tree), from_records_(from_records) {
    nodes.reserve(node_count);
    references.reserve(reference_count);
    records.reserve(node_count);
    nodes.resize(2, KdNode::leaf(0, 0));
    records.resize(2);
    copy(0, 0);
  }

  HugeVector<KdNode> nodes;
  HugeVector<std::uint32_t> references;
  std::vector<KdNodeRecord> records;

 private:
  void copy(std::uint32_t from, std::uint32_t to) {
    const KdNode source = from_.nodes[from];
    records[to] = from_records_[from];
    if (source.is_leaf()) {
      const auto first = from_.references.begin() + source.first();
      nodes[to] = KdNode::leaf(static_cast<std::uint32_t>(references.size()), source.count());
      if (source.count() > 0) references.insert(references.end(), first, first + source.count());
      return;
    }
    const auto pair = static_cast<std::uint32_t>(nodes.size());
    nodes[to] = KdNode::interior(static_cast<int>(source.axis()), source.plane(), pair);
    nodes.resize(pair + 2, KdNode::leaf(0, 0));
    records.resize(pair + 2);
    copy(source.lower_child(), pair);
    copy(source.lower_child() + 1, pair + 1);
  }

  const KdTree& from_;
  const std::vector<KdNodeRecord>& from_records_;
};

void KdTreeEditor::compact(KdTree& tree) {
  Copy copy(tree, records_, tree.nodes.size() - 2 * free_pairs_.size(), reference_count_);
  tree.nodes = std::move(copy.nodes);
  tree.references = std::move(copy.references);
  records_ = std::move(copy.records);
  free_pairs_.clear();
}

bool KdTreeEditor::finish(KdTree& tree) {
  for (std::uint32_t depth = 0; depth <= KdTree::kMaxDepth; ++depth)
    if (leaves_at_[depth] > 0) tree.depth = depth;
  // Few references left behind are no matter.
  constexpr std::uint64_t kFew = 1024;
  const bool is_worth_it = 2 * tree.references.size() > 3 * reference_count_ + kFew || 6 * free_pairs_.size() > tree.nodes.size() + kFew;
  if (is_worth_it) compact(tree);
  return is_worth_it;
}

}  // namespace grove
