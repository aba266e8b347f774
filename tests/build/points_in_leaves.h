#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "grove/accel/kd_tree.h"
#include "grove/base/random.h"
#include "grove/geometry/triangle_mesh.h"

namespace grove::testing {

/// Expects that each point of each triangle, up to rounding, lies in the cell of a leaf that refers to the triangle.
inline void expect_points_in_their_leaves(const KdTree& tree, const TriangleMesh& mesh) {
  Random random(1);
  std::size_t lost = 0;
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    if (mesh.bounds(i).is_empty()) continue;
    for (int sample = 0; sample < 8; ++sample) {
      // Corners and edges among them.
      const double u = sample < 2 ? 0.0 : random.next_float();
      const double v = sample == 0 || sample == 4 ? 0.0 : random.next_float();
      const glm::dvec3 p = mesh.surface_point(i, u, v);
      constexpr double kRounding = 1e-6;
      bool is_found = false;
      std::vector<std::uint32_t> pending{0};
      while (!pending.empty() && !is_found) {
        const KdNode node = tree.nodes[pending.back()];
        pending.pop_back();
        if (node.is_leaf()) {
          const auto first = tree.references.begin() + node.first();
          is_found = std::binary_search(first, first + node.count(), static_cast<std::uint32_t>(i));
          continue;
        }
        const double position = p[static_cast<int>(node.axis())];
        if (position <= node.plane() + kRounding) pending.push_back(node.lower_child());
        if (position >= node.plane() - kRounding) pending.push_back(node.lower_child() + 1);
      }
      lost += is_found ? 0 : 1;
    }
  }
  EXPECT_EQ(lost, 0U);
}

}  // namespace grove::testing
