#pragma once

#include <algorithm>

#include "grove/registry/accelerator.h"

namespace grove {

/// Counts what visit(box, depth, first, count) of a hierarchy shows: nodes, leaves and their sizes and depths. The caller adds bytes and
/// cost. O(nodes).
template <typename Hierarchy>
[[nodiscard]] StructureStatistics count_nodes(const Hierarchy& hierarchy) {
  constexpr std::size_t kHistogramSize = 33;
  StructureStatistics statistics;
  if constexpr (requires { hierarchy.references.size(); })
    statistics.references = hierarchy.references.size();
  else
    statistics.references = hierarchy.references;
  statistics.depth = hierarchy.depth;
  statistics.leaf_sizes.resize(kHistogramSize);
  statistics.depths.resize(hierarchy.depth + 1);
  hierarchy.visit([&](const Box& /*box*/, std::uint32_t depth, std::uint32_t /*first*/, std::uint32_t count) {
    ++statistics.nodes;
    if (count == 0) return;
    ++statistics.leaves;
    ++statistics.leaf_sizes[std::min<std::size_t>(count, kHistogramSize - 1)];
    ++statistics.depths[depth];
    statistics.largest_leaf = std::max(statistics.largest_leaf, count);
  });
  return statistics;
}

/// Shows the nodes of a hierarchy for drawing, parents first.
template <typename Hierarchy>
void view_nodes(const Hierarchy& hierarchy, const std::function<void(const NodeView&)>& visit) {
  hierarchy.visit([&](const Box& box, std::uint32_t depth, std::uint32_t number, std::uint32_t count) {
    visit({box, depth, count > 0, count, number});
  });
}

}  // namespace grove
