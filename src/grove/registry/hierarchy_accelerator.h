#pragma once

#include <memory>
#include <utility>

#include "grove/base/check.h"
#include "grove/base/timer.h"
#include "grove/build/quality/measure_quality.h"
#include "grove/registry/hierarchy_statistics.h"
#include "grove/registry/hierarchy_update.h"
#include "grove/registry/spec.h"
#include "grove/registry/structure_accelerator.h"
#include "grove/traverse/traceable_hierarchy.h"

namespace grove {

/// Builds a hierarchy over a geometry by `build(geometry)`, timing it with its leaves.
template <typename Hierarchy, Geometry G, typename Build>
[[nodiscard]] StructureState<TraceableHierarchy<Hierarchy, G>> build_hierarchy(const G& geometry, const Build& build) {
  const Timer timer;
  Hierarchy hierarchy = build(geometry);
  GROVE_ASSERT(hierarchy.validate(geometry.size()).empty());
  TraceableHierarchy<Hierarchy, G> structure(std::move(hierarchy), geometry);
  const double seconds = timer.seconds();
  const Box bounds = structure.bvh.bounds;
  return {std::move(structure), bounds, seconds, {}};
}

/// Builds a hierarchy over a geometry and wraps it as an Accelerator. `build` is kept for rebuilding; parts are rebuilt by `part_settings`.
template <typename Hierarchy, Geometry G, typename Build>
[[nodiscard]] std::unique_ptr<Accelerator> make_hierarchy_accelerator(const Spec& spec, std::shared_ptr<const G> geometry, Build build,
                                                                      const TopDownSettings& part_settings = {}) {
  using Structure = TraceableHierarchy<Hierarchy, G>;
  const auto rebuild = [build = std::move(build)](const G& set) { return build_hierarchy<Hierarchy>(set, build); };
  StructureState<Structure> state = rebuild(*geometry);
  const auto count = [](const StructureState<Structure>& s, const G& /*geometry*/) {
    StructureStatistics statistics = count_nodes(s.structure.bvh);
    statistics.expected_cost = expected_cost_of(s);
    statistics.bytes = s.structure.memory();
    return statistics;
  };
  const auto view = [](const Structure& s, const std::function<void(const NodeView&)>& visit) { view_nodes(s.bvh, visit); };
  const auto measure = [](const Structure& s, const G& set) { return measure_quality(s.bvh, set); };
  HierarchyUpdater<Hierarchy, G, decltype(rebuild)> updater(rebuild, part_settings);
  return std::make_unique<StructureAccelerator<Structure, G>>(std::move(state), std::move(geometry), spec.canonical(), count, view, measure,
                                                              std::move(updater));
}

}  // namespace grove
