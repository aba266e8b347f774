#include "grove/build/kd_tree/kd_edit_trail.h"

#include <algorithm>
#include <atomic>
#include <memory>

#include "grove/base/parallel.h"
#include "grove/build/kd_tree/kd_cell.h"

namespace grove {
namespace {

// What goes down into a node.
struct Descent {
  References arriving;
  std::vector<std::uint32_t> leaving;

  [[nodiscard]] std::size_t size() const { return arriving.size() + leaving.size(); }
};

class ChangeFollower {
 public:
  ChangeFollower(const KdTree& tree, const KdChanges& changes, const ReferenceClipper& clipper, std::int64_t most_added)
      : tree_(tree), changes_(changes), clipper_(clipper), most_added_(most_added) {}

  std::optional<KdEditTrail> run();

 private:
  class Task;

  // However many references leave: this many may be there for a while.
  [[nodiscard]] std::int64_t arrival_limit() const {
    return std::max<std::int64_t>(most_added_, 0) + static_cast<std::int64_t>(tree_.references.size());
  }

  const KdTree& tree_;
  const KdChanges& changes_;
  const ReferenceClipper& clipper_;
  std::int64_t most_added_;
  std::atomic<std::int64_t> added_ = 0;
  std::atomic<std::int64_t> arrived_ = 0;
};

// One task's part of the way.
class ChangeFollower::Task {
 public:
  Task(ChangeFollower& follower, KdEditTrail& trail) : follower_(follower), trail_(trail) {}

  void follow(KdTrailStep step, const Descent& descent) {
    const bool search_all = follower_.changes_.search_all;
    if (descent.size() == 0 && !search_all) return;
    step.first = static_cast<std::uint32_t>(trail_.steps.size());
    const KdNode node = follower_.tree_.nodes[step.node];
    if (node.is_leaf()) {
      edit_leaf(step, node, descent.arriving);
      return;
    }
    constexpr std::size_t kTaskSize = 512;
    constexpr std::uint32_t kSearchTaskDepth = 7;
    if (descent.size() >= kTaskSize || (search_all && step.depth < kSearchTaskDepth)) {
      fork(step, node, descent);
    } else {
      if (levels_.size() <= step.depth) levels_.resize(step.depth + 1);
      if (!levels_[step.depth]) levels_[step.depth] = std::make_unique<Level>();
      Level& level = *levels_[step.depth];
      part(node, descent, level.sides);
      for (int side = 0; side < 2; ++side) follow(child(step, node, side), level.sides[side]);
    }
    // A node is on the trail where something below it is.
    if (trail_.steps.size() == step.first) return;
    for (std::size_t end = trail_.steps.size(); end > step.first; end = trail_.steps[end - 1].first)
      step.changes += trail_.steps[end - 1].changes;
    trail_.steps.push_back(step);
  }

 private:
  struct Level {
    Descent sides[2];
  };

  static KdTrailStep child(const KdTrailStep& step, const KdNode& node, int side) {
    return {KdCell::child_box(step.cell, side, static_cast<int>(node.axis()), node.plane()),
            node.lower_child() + static_cast<std::uint32_t>(side),
            step.depth + 1,
            0,
            0,
            0,
            0,
            false};
  }

  void fork(const KdTrailStep& step, const KdNode& node, const Descent& descent) {
    Descent sides[2];
    part(node, descent, sides);
    KdEditTrail trails[2];
    const auto follow_side = [&](int side) { Task(follower_, trails[side]).follow(child(step, node, side), sides[side]); };
    parallel_invoke([&] { follow_side(0); }, [&] { follow_side(1); });
    for (const KdEditTrail& trail : trails) {
      const auto first_step = static_cast<std::uint32_t>(trail_.steps.size());
      const auto first_id = static_cast<std::uint32_t>(trail_.ids.size());
      for (KdTrailStep below : trail.steps) {
        below.first += first_step;
        below.first_id += first_id;
        trail_.steps.push_back(below);
      }
      trail_.ids.insert(trail_.ids.end(), trail.ids.begin(), trail.ids.end());
    }
  }

  void part(const KdNode& node, const Descent& descent, Descent sides[2]) {
    const int axis = static_cast<int>(node.axis());
    for (int side = 0; side < 2; ++side) {
      sides[side].arriving.clear();
      sides[side].leaving.clear();
    }
    if (!descent.arriving.empty() && follower_.arrived_.load(std::memory_order_relaxed) <= follower_.arrival_limit()) {
      KdPlane plane;
      plane.axis = axis;
      plane.position = node.plane();
      References* const arriving[2] = {&sides[0].arriving, &sides[1].arriving};
      part_references(descent.arriving, plane, follower_.clipper_, arriving, TrackPlaces::no, scratch_);
    }
    if (follower_.changes_.search_all) return;
    for (const std::uint32_t id : descent.leaving) {
      const Box& box = follower_.changes_.old_boxes[id];
      if (box.lower[axis] <= node.plane()) sides[0].leaving.push_back(id);
      if (box.upper[axis] >= node.plane()) sides[1].leaving.push_back(id);
    }
  }

  void edit_leaf(KdTrailStep& step, const KdNode& leaf, const References& arriving) {
    const std::uint32_t* const ids = follower_.tree_.references.data() + leaf.first();
    const auto is_changed = [&](std::uint32_t id) { return follower_.changes_.is_changed[id] != 0; };
    if (arriving.empty() && std::none_of(ids, ids + leaf.count(), is_changed)) return;
    step.is_leaf = true;
    step.first_id = static_cast<std::uint32_t>(trail_.ids.size());
    std::copy_if(ids, ids + leaf.count(), std::back_inserter(trail_.ids), [&](std::uint32_t id) { return !is_changed(id); });
    const auto middle = static_cast<std::ptrdiff_t>(trail_.ids.size());
    const std::uint32_t kept = static_cast<std::uint32_t>(middle) - step.first_id;
    step.changes = leaf.count() - kept + static_cast<std::uint32_t>(arriving.size());
    for (const PrimitiveReference& reference : arriving) trail_.ids.push_back(reference.primitive());
    std::sort(trail_.ids.begin() + middle, trail_.ids.end());
    std::inplace_merge(trail_.ids.begin() + step.first_id, trail_.ids.begin() + middle, trail_.ids.end());
    step.id_count = static_cast<std::uint32_t>(trail_.ids.size()) - step.first_id;
    follower_.arrived_ += static_cast<std::int64_t>(arriving.size());
    follower_.added_ += static_cast<std::int64_t>(step.id_count) - static_cast<std::int64_t>(leaf.count());
    trail_.steps.push_back(step);
  }

  ChangeFollower& follower_;
  KdEditTrail& trail_;
  PartScratch scratch_;
  std::vector<std::unique_ptr<Level>> levels_;
};

std::optional<KdEditTrail> ChangeFollower::run() {
  KdEditTrail trail;
  Task task(*this, trail);
  task.follow({{to_float4(tree_.bounds.lower), to_float4(tree_.bounds.upper)}, 0, 0, 0, 0, 0, 0, false},
              {changes_.arriving, changes_.leaving});
  // Sums do not depend on who came first.
  if (arrived_ > arrival_limit() || added_ > most_added_) return std::nullopt;
  trail.added = added_;
  return trail;
}

}  // namespace

std::optional<KdEditTrail> follow_changes(const KdTree& tree, const KdChanges& changes, const ReferenceClipper& clipper,
                                          std::int64_t most_added) {
  return ChangeFollower(tree, changes, clipper, most_added).run();
}

}  // namespace grove
