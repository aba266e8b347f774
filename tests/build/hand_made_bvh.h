#pragma once

#include <algorithm>
#include <initializer_list>
#include <memory>
#include <vector>

#include "grove/accel/bvh2.h"

namespace grove::testing {

/// A binary hierarchy as one writes it down: a box with ids, or with two subtrees.
struct TreeSketch {
  Box box;
  std::vector<std::uint32_t> ids;
  std::vector<TreeSketch> children;

  TreeSketch(const Box& leaf_box, std::vector<std::uint32_t> leaf_ids) : box(leaf_box), ids(std::move(leaf_ids)) {}
  /// The box is what both subtrees need.
  TreeSketch(TreeSketch left, TreeSketch right) : box(left.box) {
    box.grow(right.box);
    children.push_back(std::move(left));
    children.push_back(std::move(right));
  }
};

namespace detail {

inline Bvh2Node::Child append(const TreeSketch& sketch, std::uint32_t depth, Bvh2& bvh) {
  if (sketch.children.empty()) {
    bvh.depth = std::max(bvh.depth, depth);
    const auto first = static_cast<std::uint32_t>(bvh.references.size());
    for (const std::uint32_t id : sketch.ids) bvh.references.push_back(id);
    return {first, static_cast<std::uint32_t>(sketch.ids.size())};
  }
  const auto number = static_cast<std::uint32_t>(bvh.nodes.size());
  bvh.nodes.emplace_back();
  for (int side = 0; side < 2; ++side) {
    const TreeSketch& child = sketch.children[static_cast<std::size_t>(side)];
    const Bvh2Node::Child link = append(child, depth + 1, bvh);
    for (int axis = 0; axis < 3; ++axis) {
      bvh.nodes[number].planes[axis][side] = child.box.lower[axis];
      bvh.nodes[number].planes[axis][side + 2] = child.box.upper[axis];
    }
    bvh.nodes[number].child[side] = link;
  }
  return {number, 0};
}

}  // namespace detail

inline Bvh2 make_bvh(const TreeSketch& sketch) {
  Bvh2 bvh;
  bvh.bounds = sketch.box;
  detail::append(sketch, 0, bvh);
  return bvh;
}

}  // namespace grove::testing
