#pragma once

// How a hierarchy over boxes follows its geometry: refit, rotation, and rebuilding of parts or all, as build/passes offers them.

#include <atomic>
#include <concepts>
#include <limits>
#include <utility>
#include <vector>

#include "grove/base/timer.h"
#include "grove/build/cost_model.h"
#include "grove/build/passes/partial_rebuild.h"
#include "grove/build/passes/refit.h"
#include "grove/build/passes/rotation.h"
#include "grove/build/passes/subtree_costs.h"
#include "grove/registry/left_out_primitives.h"
#include "grove/registry/structure_accelerator.h"
#include "grove/registry/update.h"
#include "grove/traverse/traceable_hierarchy.h"

namespace grove {

/// A hierarchy whose boxes can be measured anew in place.
template <typename H>
concept Refittable = requires(H& hierarchy, Box4 (*leaf_bounds)(std::uint32_t, std::uint32_t)) {
  refit(hierarchy, leaf_bounds);
};

/// The surface-area cost of a hierarchy: as remembered, or counted. O(nodes).
template <typename Hierarchy, Geometry G>
[[nodiscard]] double expected_cost_of(const StructureState<TraceableHierarchy<Hierarchy, G>>& state) {
  return state.expected_cost ? *state.expected_cost : expected_cost(state.structure.bvh, CostModel{});
}

/// Updates one structure, and remembers what that takes. `Rebuild` is called as rebuild(geometry) and returns a StructureState.
template <typename Hierarchy, Geometry G, typename Rebuild>
class HierarchyUpdater {
 public:
  using State = StructureState<TraceableHierarchy<Hierarchy, G>>;

  HierarchyUpdater(Rebuild rebuild, const TopDownSettings& part_settings) : rebuild_(std::move(rebuild)), part_settings_(part_settings) {}

  UpdateReport operator()(State& state, const G& geometry, const UpdateSettings& settings) {
    const Timer timer;
    UpdateReport report;
    report.built_cost = remember(state, geometry);
    report.cost = report.built_cost;
    bool must_rebuild = settings.policy == UpdatePolicy::rebuild;
    if constexpr (Refittable<Hierarchy>) {
      must_rebuild = must_rebuild || left_out_.appeared(geometry) || !refit_boxes(state, geometry, report);
      if (!must_rebuild) must_rebuild = improve(state, geometry, settings, report);
    } else {
      must_rebuild = true;
    }
    if (must_rebuild) {
      state = rebuild_(geometry);
      is_known_ = false;
      report.method = UpdateMethod::rebuild;
      report.rotations = 0;
      report.rebuilt_references = state.structure.bvh.references.size();
      report.cost = expected_cost_of(state);
    }
    state.expected_cost = report.cost;
    state.bounds = state.structure.bvh.bounds;
    report.seconds = timer.seconds();
    return report;
  }

 private:
  // What is known of the structure as it was built, taken down before its boxes change. Returns its expected cost.
  double remember(const State& state, const G& geometry) {
    if (is_known_) {
      left_out_.add_up_to(geometry.size());
      return built_cost_;
    }
    const Hierarchy& bvh = state.structure.bvh;
    built_cost_ = expected_cost_of(state);
    left_out_.take(geometry.size(), [&](const auto& tell) {
      for (const std::uint32_t reference : bvh.references) tell(reference);
    });
    if constexpr (std::same_as<Hierarchy, Bvh2>) built_ = measure_subtree_costs(bvh).per_entry;
    is_known_ = true;
    return built_cost_;
  }

  // Returns whether the structure can go on: everything in it can still be hit, and its cost is a number.
  static bool refit_boxes(State& state, const G& geometry, UpdateReport& report) {
    auto& structure = state.structure;
    const std::uint32_t* const references = structure.bvh.references.data();
    std::atomic<bool> all_hittable = true;
    const auto leaf_bounds = [&](std::uint32_t first, std::uint32_t count) {
      bool all = true;
      const Box4 box = structure.leaves.refresh(geometry, references, first, count, all);
      if (!all) all_hittable.store(false, std::memory_order_relaxed);
      return box;
    };
    report.method = UpdateMethod::refit;
    report.refitted_cost = report.cost = refit(structure.bvh, leaf_bounds);
    return all_hittable && report.cost <= std::numeric_limits<double>::max();
  }

  // What the policy adds to a refit. Returns whether all is to be built anew.
  bool improve(State& state, const G& geometry, const UpdateSettings& settings, UpdateReport& report) {
    if (settings.policy == UpdatePolicy::refit) return false;
    Hierarchy& bvh = state.structure.bvh;
    RebuildDecision decision;
    decision.rays = settings.rays;
    if constexpr (std::same_as<Hierarchy, Bvh2>) {
      if (bvh.nodes.empty()) return false;
      std::vector<std::uint8_t> changed(bvh.nodes.size(), 0);
      const Rotated rotated = rotate(bvh, {}, changed);
      report.method = UpdateMethod::rotate;
      report.rotations = rotated.rotations;
      report.cost = rotated.cost;
      const bool decides = settings.policy == UpdatePolicy::automatic;
      if (!decides && rotated.rotations == 0) return false;
      const SubtreeCosts now = measure_subtree_costs(bvh);
      // Where other references have come together there is no better to go back to that is known.
      for (std::size_t i = 0; i < changed.size(); ++i)
        if (changed[i] != 0) built_[i] = now.per_entry[i];
      if (!decides) return false;
      const std::vector<std::uint32_t> roots = choose_rebuilds(bvh, now, built_, decision);
      if (roots.empty()) return false;
      if (roots.front() == 0) return true;
      rebuild_parts(state, geometry, roots, now, report);
      return false;
    } else {
      return settings.policy == UpdatePolicy::automatic &&
             decision.rays * (report.cost - report.built_cost) > decision.steps_per_reference * static_cast<double>(bvh.references.size());
    }
  }

  void rebuild_parts(State& state, const G& geometry, const std::vector<std::uint32_t>& roots, const SubtreeCosts& before,
                     UpdateReport& report) {
    auto& structure = state.structure;
    SplicedHierarchy spliced = rebuild_subtrees(
        structure.bvh, roots, [&](std::uint32_t i) { return geometry.bounds(i); }, part_settings_);
    for (const std::uint32_t root : roots) report.rebuilt_references += before.references[root];
    const SubtreeCosts now = measure_subtree_costs(spliced.bvh);
    std::vector<float> built(now.per_entry);
    for (std::size_t i = 0; i < built.size(); ++i)
      if (spliced.old_number[i] != SplicedHierarchy::kNewNode) built[i] = built_[spliced.old_number[i]];
    built_ = std::move(built);
    structure = TraceableHierarchy<Hierarchy, G>(std::move(spliced.bvh), geometry);
    report.method = UpdateMethod::partial_rebuild;
    report.cost = now.total;
  }

  Rebuild rebuild_;
  TopDownSettings part_settings_;
  bool is_known_ = false;
  double built_cost_ = 0.0;
  LeftOutPrimitives left_out_;
  std::vector<float> built_;  // cost per entry of each node of a binary hierarchy, as it was built
};

}  // namespace grove
