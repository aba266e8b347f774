#pragma once

#include <algorithm>
#include <limits>

#include "grove/build/splits/spatial.h"
#include "grove/build/top_down_driver.h"

namespace grove {

/// Builds a binary hierarchy with spatial splits (build/splits/spatial.h): a primitive may be referenced by several leaves, at most
/// (1 + settings.duplication_budget) references a primitive on average; no leaf names one twice. The rest as build_top_down; peak memory grows with the budget.
template <Geometry G>
[[nodiscard]] Bvh2 build_with_spatial_splits(const G& geometry, const TopDownSettings& settings) {
  ReferenceList list = list_references(geometry);
  const AreaMeasure measure(list.bounds);
  const SplitContext context{measure.scale(), SubsetTime(settings.cost)};
  const auto least_overlap = static_cast<float>(settings.least_overlap * measure.half_area(list.bounds));
  const std::size_t size = list.references.size();
  const double wanted = static_cast<double>(size) * (1.0 + settings.duplication_budget);
  const auto capacity = static_cast<std::size_t>(std::min(wanted, static_cast<double>(std::numeric_limits<std::int32_t>::max())));
  const SpatialHeuristic<G> heuristic(context, geometry, least_overlap, static_cast<float>(settings.least_overlap_of_range));
  return detail::drive_top_down(std::move(list), std::max(capacity, size), settings, heuristic);
}

}  // namespace grove
