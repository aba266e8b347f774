#pragma once

#include <cstdint>

#include "grove/registry/update.h"

namespace grove {

/// What an update tells of a structure as it stands.
struct StructureMeasure {
  double cost = 0.0;
  std::uint64_t references = 0;
};

/// Follows a geometry by building anew, rebuild(geometry); measure(state) returns a StructureMeasure.
template <typename State, typename G, typename Rebuild, typename Measure>
[[nodiscard]] UpdateReport update_by_rebuilding(State& state, const G& geometry, const Rebuild& rebuild, const Measure& measure) {
  UpdateReport report;
  report.built_cost = measure(state).cost;
  state = rebuild(geometry);
  const StructureMeasure now = measure(state);
  report.cost = now.cost;
  report.rebuilt_references = now.references;
  report.seconds = state.build_seconds;
  return report;
}

}  // namespace grove
