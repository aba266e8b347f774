#pragma once

// What registry/hierarchy_statistics.h does for hierarchies, for kd-trees, whose leaves may be empty.

#include <algorithm>

#include "grove/accel/kd_tree.h"
#include "grove/registry/accelerator.h"

namespace grove {

/// Counts nodes, leaves (the empty ones too) and their sizes and depths. The caller adds bytes and cost. O(nodes).
[[nodiscard]] inline StructureStatistics count_nodes(const KdTree& tree) {
  constexpr std::size_t kHistogramSize = 33;
  StructureStatistics statistics;
  statistics.depth = tree.depth;
  statistics.leaf_sizes.resize(kHistogramSize);
  statistics.depths.resize(tree.depth + 1);
  tree.visit([&](const Box& /*cell*/, std::uint32_t depth, const KdNode& node) {
    ++statistics.nodes;
    if (!node.is_leaf()) return;
    ++statistics.leaves;
    statistics.references += node.count();
    ++statistics.leaf_sizes[std::min<std::size_t>(node.count(), kHistogramSize - 1)];
    ++statistics.depths[depth];
    statistics.largest_leaf = std::max(statistics.largest_leaf, node.count());
  });
  return statistics;
}

/// Shows the cells for drawing, parents first.
inline void view_nodes(const KdTree& tree, const std::function<void(const NodeView&)>& visit) {
  tree.visit([&](const Box& cell, std::uint32_t depth, const KdNode& node) {
    if (node.is_leaf()) {
      visit({cell, depth, true, node.count(), node.first()});
      return;
    }
    NodeView view{cell, depth, false, 0, node.lower_child(), static_cast<std::uint8_t>(1U << node.axis())};
    view.planes[static_cast<int>(node.axis())] = node.plane();
    visit(view);
  });
}

}  // namespace grove
