#pragma once

// How tasks put a binary hierarchy together: each returns a part, and the parts are copied to their places at the end.

#include <cstdint>
#include <memory>
#include <vector>

#include "grove/accel/bvh2.h"
#include "grove/math/float4.h"

namespace grove {

/// A finished part of a hierarchy: nodes numbered from 0 whose root is node 0, or a single leaf, or a node over two parts.
struct HierarchyPart {
  std::vector<Bvh2Node> nodes;
  Bvh2Node::Child link{};
  std::uint32_t depth = 0;
  std::unique_ptr<HierarchyPart> children[2];
  Box4 bounds[2];
  std::uint32_t offset = 0;

  [[nodiscard]] bool is_leaf() const { return link.count > 0; }
};

void set_children(Bvh2Node& node, const Box4& left, const Box4& right);

/// Copies the parts to `bvh.nodes` in depth-first order, in parallel, and sets its depth.
void assemble(HierarchyPart& root, Bvh2& bvh);

}  // namespace grove
