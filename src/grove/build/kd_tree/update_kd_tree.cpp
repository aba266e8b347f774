#include "grove/build/kd_tree/update_kd_tree.h"

#include <algorithm>
#include <utility>

namespace grove {
namespace {

KdCostContext costs_in(const Box& bounds, const KdTreeSettings& settings) {
  return {AreaMeasure(bounds).scale(), settings.cost, settings.empty_bonus};
}

Box4 to_box4(const Box& box) {
  return {to_float4(box.lower), to_float4(box.upper)};
}

double cost_of(const KdTree& tree, const KdTreeEditor& editor, const KdCostContext& costs) {
  const float area = scaled_half_area(to_box4(tree.bounds), costs.area_scale);
  return area > 0.0F ? static_cast<double>(editor.record(0).cost) / static_cast<double>(area) : expected_cost(tree, costs.model);
}

}  // namespace

/// One update, once it is known which leaves change.
class KdTreeUpdater::Update {
 public:
  Update(KdTree& tree, KdTreeEditor& editor, std::span<const Box> boxes, const KdEditTrail& trail, const KdBuildContext& context,
         std::uint64_t capacity)
      : tree_(tree), editor_(editor), boxes_(boxes), trail_(trail), context_(context), capacity_(capacity) {}

  void edit_leaves() {
    const std::vector<KdTreePart> parts = part_grown_leaves();
    auto part = parts.begin();
    for (const KdTrailStep& step : trail_.steps) {
      editor_.count_changes(step.node, step.changes);
      if (!step.is_leaf) {
        editor_.sum_up(tree_, step.node, step.cell);
        merge_leaves(step);
      } else if (!has_grown(step)) {
        editor_.make_leaf(tree_, step.node, step.cell, step.depth, ids_of(step));
      } else {
        if (part->is_joined() || part->nodes.size() > 2) {
          editor_.replace(tree_, step.node, step.cell, step.depth, *part);
        } else {
          editor_.make_leaf(tree_, step.node, step.cell, step.depth, ids_of(step));
        }
        ++part;
      }
    }
  }

  /// Returns how many references lie in them, or nothing where all of the tree should be.
  std::optional<std::uint64_t> rebuild_subtrees(const KdRebuildRule& rule) {
    if (rule.rays <= 0.0 || trail_.steps.empty()) return 0;
    const auto root = static_cast<std::uint32_t>(trail_.steps.size() - 1);
    std::vector<std::uint32_t> chosen;
    choose(root, rule, chosen);
    if (chosen.empty()) return 0;
    if (chosen.front() == root) return std::nullopt;
    std::vector<KdTreePart> parts(chosen.size());
    std::uint64_t references = 0;
    for (const std::uint32_t i : chosen) references += editor_.record(trail_.steps[i].node).references;
    parallel_for(chosen.size(), 1, [&](std::size_t k) {
      const KdTrailStep& step = trail_.steps[chosen[k]];
      parts[k] = build(step, primitives_below(step.node), capacity_for(editor_.record(step.node).references));
    });
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      const KdTrailStep& step = trail_.steps[chosen[k]];
      editor_.replace(tree_, step.node, step.cell, step.depth, parts[k]);
    }
    sum_up_above(root, chosen);
    return references;
  }

 private:
  [[nodiscard]] std::span<const std::uint32_t> ids_of(const KdTrailStep& step) const {
    return {trail_.ids.data() + step.first_id, step.id_count};
  }

  // Whether a leaf is looked at again: it has more references than when it was left as it is. Tells of the tree before the leaf is edited.
  [[nodiscard]] bool has_grown(const KdTrailStep& step) const {
    return step.id_count > tree_.nodes[step.node].count() && step.id_count > context_.settings.leaf_size &&
           step.depth < context_.most_depth;
  }

  // References that a subtree may come to which has `count` now: with its share of those that the whole tree may still be given.
  [[nodiscard]] std::uint64_t capacity_for(std::uint64_t count) const {
    const std::uint64_t total = editor_.reference_count();
    const std::uint64_t slack = capacity_ > total ? capacity_ - total : 0;
    return count + static_cast<std::uint64_t>(static_cast<double>(slack) * static_cast<double>(count) / static_cast<double>(total));
  }

  [[nodiscard]] KdTreePart build(const KdTrailStep& step, std::span<const std::uint32_t> ids, std::uint64_t capacity) const {
    References references(ids.size());
    const Box cell = step.cell.box();
    constexpr std::size_t kChunk = 1024;
    parallel_chunks(ids.size(), kChunk, [&](std::size_t /*id*/, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) references[i] = make_reference(boxes_[ids[i]].intersection(cell), ids[i]);
      context_.clipper.clip({references.data() + first, last - first});
    });
    // Where rounding says that nothing is inside, the box stays: it is in the leaf for a reason.
    for (std::size_t i = 0; i < ids.size(); ++i)
      if (is_outside(references[i])) references[i] = make_reference(boxes_[ids[i]].intersection(cell), ids[i]);
    return build_kd_tree_part(std::move(references), {step.cell, step.depth, 0, std::max<std::uint64_t>(capacity, ids.size())}, context_);
  }

  [[nodiscard]] std::vector<KdTreePart> part_grown_leaves() const {
    std::vector<const KdTrailStep*> grown;
    std::uint64_t references = 0;
    for (const KdTrailStep& step : trail_.steps) {
      if (!step.is_leaf || !has_grown(step)) continue;
      grown.push_back(&step);
      references += step.id_count;
    }
    std::vector<KdTreePart> parts(grown.size());
    // What leaves get more counts before it is shared.
    const std::uint64_t after = editor_.reference_count() + static_cast<std::uint64_t>(trail_.added);
    const std::uint64_t slack = capacity_ > after ? capacity_ - after : 0;
    parallel_for(grown.size(), 16, [&](std::size_t k) {
      const KdTrailStep& step = *grown[k];
      const double share = static_cast<double>(slack) * step.id_count / static_cast<double>(references);
      parts[k] = build(step, ids_of(step), step.id_count + static_cast<std::uint64_t>(share));
    });
    return parts;
  }

  // Two leaves become one where that is cheaper.
  void merge_leaves(const KdTrailStep& step) {
    const std::uint32_t pair = tree_.nodes[step.node].lower_child();
    const KdNode lower = tree_.nodes[pair];
    const KdNode upper = tree_.nodes[pair + 1];
    if (!lower.is_leaf() || !upper.is_leaf()) return;
    const float cost = editor_.record(step.node).cost;
    if (editor_.cost_of_leaf(step.cell, std::max(lower.count(), upper.count())) > cost) return;
    merged_.clear();
    const std::uint32_t* const references = tree_.references.data();
    std::set_union(references + lower.first(), references + lower.first() + lower.count(), references + upper.first(),
                   references + upper.first() + upper.count(), std::back_inserter(merged_));
    if (editor_.cost_of_leaf(step.cell, merged_.size()) <= cost) editor_.make_leaf(tree_, step.node, step.cell, step.depth, merged_);
  }

  // Calls visit(step) for the steps of a step's children, lower before upper.
  template <typename Visit>
  void for_children(std::uint32_t i, const Visit& visit) const {
    const KdTrailStep& step = trail_.steps[i];
    if (step.first == i) return;
    const std::uint32_t last = i - 1;
    if (trail_.steps[last].first > step.first) visit(trail_.steps[last].first - 1);
    visit(last);
  }

  // Appends the best choice at and below a step to `chosen`, and returns what it saves, in steps of a traversal.
  double choose(std::uint32_t i, const KdRebuildRule& rule, std::vector<std::uint32_t>& chosen) const {
    const KdTrailStep& step = trail_.steps[i];
    const KdNodeRecord& record = editor_.record(step.node);
    if (tree_.nodes[step.node].is_leaf() || record.references < rule.least_references) return 0.0;
    const std::size_t before = chosen.size();
    double below = 0.0;
    for_children(i, [&](std::uint32_t child) { below += choose(child, rule, chosen); });
    const KdCostContext costs = context_.costs();
    const double excess =
        static_cast<double>(record.cost) - static_cast<double>(record.built) * static_cast<double>(costs.measure(step.cell));
    // What the subtree costs more may be due to what is in it now, so no more is expected of building it anew than as many changes have been seen to spoil.
    const double changed = 0.5 * record.changes / std::max<double>(record.references, 1.0);
    const double saved = std::min(excess, rule.cost_of_change * changed * static_cast<double>(record.cost));
    const double of_root = static_cast<double>(costs.measure(trail_.steps.back().cell));
    const double whole = rule.rays * (saved / of_root) - rule.steps_per_reference * record.references;
    if (!(whole > below)) return below;
    chosen.resize(before);
    chosen.push_back(i);
    return whole;
  }

  // The primitives below a node, each once, ascending.
  [[nodiscard]] std::vector<std::uint32_t> primitives_below(std::uint32_t node) const {
    std::vector<std::uint32_t> ids;
    std::vector<std::uint32_t> pending{node};
    while (!pending.empty()) {
      const KdNode here = tree_.nodes[pending.back()];
      pending.pop_back();
      if (here.is_leaf()) {
        ids.insert(ids.end(), tree_.references.data() + here.first(), tree_.references.data() + here.first() + here.count());
      } else {
        pending.push_back(here.lower_child());
        pending.push_back(here.lower_child() + 1);
      }
    }
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
  }

  // Sums up what is at and below a step, of which `chosen` are the steps that were rebuilt.
  void sum_up_above(std::uint32_t i, std::span<const std::uint32_t> chosen) {
    const KdTrailStep& step = trail_.steps[i];
    // The first that was rebuilt in this subtree; below itself there is nothing to do.
    const auto next = std::lower_bound(chosen.begin(), chosen.end(), step.first);
    if (next == chosen.end() || *next >= i) return;
    for_children(i, [&](std::uint32_t child) { sum_up_above(child, chosen); });
    editor_.sum_up(tree_, step.node, step.cell);
  }

  KdTree& tree_;
  KdTreeEditor& editor_;
  std::span<const Box> boxes_;
  const KdEditTrail& trail_;
  const KdBuildContext& context_;
  std::uint64_t capacity_;
  std::vector<std::uint32_t> merged_;
};

bool KdTreeUpdater::is_search_cheaper(const KdTree& tree, std::span<const std::uint32_t> leaving) const {
  // Of a box, about as much of all leaves as it has of the area; and the way there.
  constexpr double kWay = 32.0;
  const AreaMeasure measure(tree.bounds);
  const double nodes = static_cast<double>(tree.nodes.size());
  double area = 0.0;
  for (const std::uint32_t id : leaving) area += measure.half_area(boxes_[id]);
  const double whole = measure.half_area(tree.bounds);
  return kWay * static_cast<double>(leaving.size()) + (whole > 0.0 ? area / whole * nodes : 0.0) > 0.5 * nodes;
}

KdTreeUpdate KdTreeUpdater::follow(KdTree& tree, const ReferenceClipper& clipper, std::span<const std::uint32_t> changed,
                                   std::span<const Box> boxes, const KdRebuildRule& rule, bool were_known) {
  KdTreeUpdate update;
  update.must_rebuild = true;
  if (tree.nodes.empty()) return update;
  if (!were_known) {
    const KdCostContext costs = costs_in(tree.bounds, settings_);
    editor_.study(tree, costs);
    built_cost_ = cost_of(tree, editor_, costs);
    built_bounds_ = tree.bounds;
    hittable_ = static_cast<std::size_t>(std::count_if(boxes_.begin(), boxes_.end(), [](const Box& box) { return !box.is_empty(); }));
    is_changed_.clear();
    is_known_ = true;
  }
  is_changed_.resize(boxes_.size(), 0);

  KdChanges changes;
  changes.old_boxes = boxes_;
  Box bounds = tree.bounds;
  for (std::size_t i = 0; i < changed.size(); ++i) {
    const std::uint32_t id = changed[i];
    if (std::exchange(is_changed_[id], 1) != 0) continue;
    if (were_known && !boxes_[id].is_empty()) changes.leaving.push_back(id);
    if (boxes[i].is_empty()) continue;
    changes.arriving.push_back(make_reference(boxes[i], id));
    bounds.grow(boxes[i]);
  }
  changes.is_changed = is_changed_;
  changes.search_all = !were_known || is_search_cheaper(tree, changes.leaving);
  // Cells at the border grow with the bounds; what they refer to stays right.
  if (!tree.bounds.contains(bounds)) {
    const KdCostContext costs = costs_in(bounds, settings_);
    if (rule.rays > 0.0 && costs.measure(to_box4(bounds)) > 2.0F * costs.measure(to_box4(built_bounds_))) return update;
    tree.bounds = bounds;
    editor_.measure_again(tree, costs);
  }
  if (were_known) hittable_ += changes.arriving.size() - changes.leaving.size();
  const auto capacity = static_cast<std::uint64_t>(settings_.most_references * static_cast<double>(hittable_));
  const auto most_added = static_cast<std::int64_t>(capacity) - static_cast<std::int64_t>(editor_.reference_count());
  const std::optional<KdEditTrail> trail = follow_changes(tree, changes, clipper, most_added);
  for (std::size_t i = 0; i < changed.size(); ++i) {
    is_changed_[changed[i]] = 0;
    boxes_[changed[i]] = boxes[i];
  }
  const bool is_large = tree.nodes.size() > KdTree::kMaxNodes / 2 || tree.references.size() > KdTree::kMaxNodes;
  if (!trail || hittable_ == 0 || is_large) return update;

  const KdCostContext costs = costs_in(tree.bounds, settings_);
  const KdBuildContext context{clipper, settings_, costs.area_scale, most_depth(settings_, hittable_)};
  editor_.clear_changed_slots();
  Update work(tree, editor_, boxes_, *trail, context, capacity);
  work.edit_leaves();
  const std::optional<std::uint64_t> rebuilt = work.rebuild_subtrees(rule);
  if (!rebuilt) return update;
  update.must_rebuild = false;
  update.rebuilt_references = *rebuilt;
  update.is_compacted = editor_.finish(tree);
  update.slots = editor_.changed_slots();
  update.cost = cost_of(tree, editor_, costs);
  return update;
}

}  // namespace grove
