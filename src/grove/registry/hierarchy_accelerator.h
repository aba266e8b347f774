#pragma once

#include <memory>
#include <utility>

#include "grove/base/check.h"
#include "grove/base/timer.h"
#include "grove/build/cost_model.h"
#include "grove/registry/hierarchy_statistics.h"
#include "grove/registry/spec.h"
#include "grove/registry/structure_accelerator.h"
#include "grove/traverse/traceable_hierarchy.h"

namespace grove {

/// Builds a hierarchy over a geometry by `build(geometry)`, timing it with its leaves, and wraps it as an Accelerator.
template <typename Hierarchy, Geometry G, typename Build>
[[nodiscard]] std::unique_ptr<Accelerator> make_hierarchy_accelerator(const Spec& spec, std::shared_ptr<const G> geometry,
                                                                      const Build& build) {
  using Structure = TraceableHierarchy<Hierarchy, G>;
  const Timer timer;
  Hierarchy hierarchy = build(*geometry);
  GROVE_ASSERT(hierarchy.validate(geometry->size()).empty());
  Structure structure(std::move(hierarchy), *geometry);
  const double seconds = timer.seconds();
  StructureStatistics statistics = count_nodes(structure.bvh);
  statistics.expected_cost = expected_cost(structure.bvh, CostModel{});
  statistics.bytes = structure.memory();
  statistics.primitives = geometry->size();
  statistics.build_seconds = seconds;
  const Box bounds = structure.bvh.bounds;
  const auto view = [](const Structure& s, const std::function<void(const NodeView&)>& visit) { view_nodes(s.bvh, visit); };
  return std::make_unique<StructureAccelerator<Structure, G>>(std::move(structure), std::move(geometry), spec.canonical(), bounds,
                                                              std::move(statistics), view);
}

}  // namespace grove
