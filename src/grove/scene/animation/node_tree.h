#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "grove/math/vector.h"

namespace grove {

/// Where a node stands in its parent's space.
struct NodePose {
  glm::dvec3 translation{0.0};
  glm::dvec4 rotation{0.0, 0.0, 0.0, 1.0};  ///< quaternion x, y, z, w of any length
  glm::dvec3 scale{1.0};
  /// In place of the three, for nodes that have a matrix, which do not move.
  std::optional<glm::dmat4> matrix;

  [[nodiscard]] glm::dmat4 local() const;
};

/// A forest of nodes, by their numbers in the file.
struct NodeTree {
  static constexpr std::uint32_t kNoParent = 0xffffffffU;

  std::vector<std::uint32_t> parent;  ///< or kNoParent
  /// The nodes that can be reached from a root, parents before children; others (in a cycle that nothing reaches) are in no place.
  std::vector<std::uint32_t> order;
  std::vector<NodePose> rest;  ///< as the file has it

  [[nodiscard]] std::size_t size() const { return parent.size(); }
  /// Node to world for each node posed as in `poses`; NaN for those in no place. Multiplied in double, as chains of a hundred nodes are common. O(nodes).
  [[nodiscard]] std::vector<Mat4> world_transforms(const std::vector<NodePose>& poses) const;
  /// For each node whether it or a node above it is marked.
  [[nodiscard]] std::vector<bool> below(const std::vector<bool>& marked) const;
};

}  // namespace grove
