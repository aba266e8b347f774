#pragma once

// How tasks put a kd-tree together: each returns a part, and the parts are copied to their places at the end.

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "grove/accel/kd_tree.h"

namespace grove {

/// A finished part: nodes numbered as in KdTree with references counted from 0, or a plane over two parts.
struct KdTreePart {
  std::vector<KdNode> nodes;
  std::vector<std::uint32_t> references;
  std::uint32_t depth = 0;
  int axis = 0;
  float position = 0.0F;
  std::array<std::unique_ptr<KdTreePart>, 2> children;  ///< both or none; with them `nodes` and `references` are empty

  [[nodiscard]] bool is_joined() const { return children[0] != nullptr; }
};

/// Copies the parts to a tree, in parallel. Throws InputError where there are more nodes than KdTree::kMaxNodes.
[[nodiscard]] KdTree assemble(const KdTreePart& root, const Box& bounds);

}  // namespace grove
