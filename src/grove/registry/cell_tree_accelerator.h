#pragma once

#include <memory>
#include <utility>

#include "grove/build/cost_model.h"
#include "grove/registry/structure_accelerator.h"

namespace grove {

/// The expected cost of a structure with a `tree` of cells, where it is not known yet. O(nodes).
template <typename Structure>
[[nodiscard]] double cost_of(const StructureState<Structure>& state) {
  return state.expected_cost ? *state.expected_cost : expected_cost(state.structure.tree, CostModel());
}

/// Whether looking at the changed primitives alone is worth it: it is where they are told and, for `automatic`, are at most one in `share` of all.
[[nodiscard]] inline bool is_worth_local(const UpdateSettings& settings, std::size_t size, std::size_t share) {
  if (settings.policy == UpdatePolicy::rebuild || settings.changed.empty()) return false;
  return settings.policy != UpdatePolicy::automatic || settings.changed.size() <= size / share;
}

/// Wraps a structure with a `tree` of cells, for which count_nodes(tree) and view_nodes(tree, visit) exist, as an Accelerator; `updater` makes it follow
/// the geometry.
template <typename Structure, Geometry G, typename Updater>
[[nodiscard]] std::unique_ptr<Accelerator> make_cell_tree_accelerator(const std::string& spec, StructureState<Structure> state,
                                                                      std::shared_ptr<const G> geometry, Updater updater) {
  const auto count = [](const StructureState<Structure>& s, const G& /*geometry*/) {
    StructureStatistics statistics = count_nodes(s.structure.tree);
    statistics.expected_cost = cost_of(s);
    statistics.bytes = s.structure.memory();
    return statistics;
  };
  const auto view = [](const Structure& structure, const std::function<void(const NodeView&)>& visit) {
    view_nodes(structure.tree, visit);
  };
  // Overlap is a measure of hierarchies: cells have none.
  const auto measure = [](const Structure&, const G&) { return StructureQuality{}; };
  return std::make_unique<StructureAccelerator<Structure, G>>(std::move(state), std::move(geometry), spec, count, view, measure,
                                                              std::move(updater));
}

}  // namespace grove
