#pragma once

// What registry/hierarchy_statistics.h does for hierarchies, for octrees, whose nodes may have references of their own.

#include <algorithm>

#include "grove/accel/octree.h"
#include "grove/registry/accelerator.h"

namespace grove {

/// Counts nodes, leaves and their sizes and depths; a node's own references count as a leaf at the node's depth. The caller adds bytes and cost. O(nodes).
[[nodiscard]] inline StructureStatistics count_nodes(const Octree& tree) {
  constexpr std::size_t kHistogramSize = 33;
  StructureStatistics statistics;
  statistics.references = tree.references.size();
  statistics.depth = tree.depth;
  statistics.leaf_sizes.resize(kHistogramSize);
  statistics.depths.resize(tree.depth + 1);
  tree.visit([&](const Octree::Visited& visited) {
    ++statistics.nodes;
    if (!visited.is_leaf) return;
    ++statistics.leaves;
    ++statistics.leaf_sizes[std::min<std::size_t>(visited.count, kHistogramSize - 1)];
    ++statistics.depths[visited.depth];
    statistics.largest_leaf = std::max(statistics.largest_leaf, visited.count);
  });
  return statistics;
}

/// Shows the cells, as far as they lie in the bounds of what is in the tree, for drawing; parents first.
inline void view_nodes(const Octree& tree, const std::function<void(const NodeView&)>& visit) {
  tree.visit([&](const Octree::Visited& visited) {
    const Box cell = visited.cell.intersection(tree.bounds);
    if (visited.is_leaf) {
      visit({cell, visited.depth, true, visited.count, visited.first});
      return;
    }
    const OctreeNode& node = tree.nodes[visited.node];
    visit({cell, visited.depth, false, 0, visited.node, node.cut_axes, {node.planes[0], node.planes[1], node.planes[2]}});
  });
}

}  // namespace grove
