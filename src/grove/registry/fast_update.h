#pragma once

// How the hierarchy of the fast path over a mesh follows it: refit, or building anew where that pays or must be.

#include <limits>
#include <utility>

#include "grove/base/timer.h"
#include "grove/build/cost_model.h"
#include "grove/build/fast/refit_fast.h"
#include "grove/build/passes/partial_rebuild.h"
#include "grove/registry/left_out_primitives.h"
#include "grove/registry/update.h"

namespace grove {

/// Updates one structure, a StructureState whose structure has a `bvh`, and remembers what that takes. `Rebuild` is called as rebuild(mesh) and returns such a
/// state. There are no rotations: `rotate` is `refit`. `automatic` weighs a refit against building anew as wide hierarchies do (RebuildDecision).
template <typename State, typename Rebuild>
class FastUpdater {
 public:
  explicit FastUpdater(Rebuild rebuild) : rebuild_(std::move(rebuild)) {}

  UpdateReport operator()(State& state, const TriangleMesh& mesh, const UpdateSettings& settings) {
    const Timer timer;
    remember(state, mesh);
    UpdateReport report;
    report.built_cost = built_cost_;
    if (settings.policy == UpdatePolicy::rebuild || left_out_.appeared(mesh) || !refit(state, mesh, settings, report)) {
      state = rebuild_(mesh);
      is_known_ = false;
      report.method = UpdateMethod::rebuild;
      report.rebuilt_references = state.structure.bvh.references;
      report.cost = expected_cost(state.structure.bvh, CostModel{});
    }
    state.expected_cost = report.cost;
    state.bounds = state.structure.bvh.bounds;
    report.seconds = timer.seconds();
    return report;
  }

 private:
  void remember(const State& state, const TriangleMesh& mesh) {
    if (is_known_) return left_out_.add_up_to(mesh.size());
    const auto& bvh = state.structure.bvh;
    built_cost_ = state.expected_cost ? *state.expected_cost : expected_cost(bvh, CostModel{});
    left_out_.take(mesh.size(), [&](const auto& tell) {
      for (const auto& block : bvh.blocks())
        for (const std::uint32_t primitive : block.primitive) tell(primitive);
    });
    is_known_ = true;
  }

  // Returns whether the structure can go on as it is then.
  static bool refit(State& state, const TriangleMesh& mesh, const UpdateSettings& settings, UpdateReport& report) {
    const FastRefit refitted = refit_fast(state.structure.bvh, mesh);
    report.method = UpdateMethod::refit;
    report.refitted_cost = report.cost = refitted.cost;
    if (!refitted.all_hittable || !(refitted.cost <= std::numeric_limits<double>::max())) return false;
    RebuildDecision decision;
    decision.rays = settings.rays;
    return settings.policy != UpdatePolicy::automatic ||
           decision.rays * (report.cost - report.built_cost) <=
               decision.steps_per_reference * static_cast<double>(state.structure.bvh.references);
  }

  Rebuild rebuild_;
  LeftOutPrimitives left_out_;
  double built_cost_ = 0.0;
  bool is_known_ = false;
};

}  // namespace grove
