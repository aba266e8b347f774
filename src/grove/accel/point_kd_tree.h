#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include "grove/base/huge_vector.h"

namespace grove {

/// A point of K dimensions.
template <std::size_t kDimensions>
using Point = std::array<float, kDimensions>;

/// Points with a coordinate beyond this, or one that is not a number, are in no tree, and queries with one find nothing: so squared distances in up to 16
/// dimensions are finite.
inline constexpr float kMaxPointCoordinate = 1e18F;

template <std::size_t kDimensions>
[[nodiscard]] bool is_usable_point(const Point<kDimensions>& point) {
  bool is_usable = true;
  for (const float c : point) is_usable = is_usable && c >= -kMaxPointCoordinate && c <= kMaxPointCoordinate;
  return is_usable;
}

/// An interior node of a PointKdTree: what lies below it on one side ends where `lower_end` says along the axis, what lies on the other begins at
/// `upper_begin`. Between them is nothing.
struct PointKdNode {
  float lower_end;
  float upper_begin;
  std::uint32_t axis;
};

static_assert(sizeof(PointKdNode) == 12);

/// A kd-tree over points (Bentley 1975, "Multidimensional Binary Search Trees Used for Associative Searching"; points in buckets: Friedman, Bentley and
/// Finkel 1977, "An Algorithm for Finding Best Matches in Logarithmic Expected Time"), as plain data.
///
/// All leaves are at one depth, and sizes of leaves differ by one at most, so nodes need no links: the children of node i are 2 i + 1 and 2 i + 2. The points
/// of a leaf stand in a block, all first coordinates together, then all second ones:
///
///     leaf 0                        leaf 1
///     x x x x x x x x  y y y y y y y y  z z z z z z z z | x x …
///
/// Lanes without a point hold NaN, so they are at no distance and in no range. (4 K + 4) bytes a lane, of which more than half are used once there are more
/// than kLeafSize points, and 1.5 bytes for a node.
template <std::size_t kDimensions>
struct PointKdTree {
  static_assert(kDimensions >= 2 && kDimensions <= 16);
  static constexpr std::uint32_t kLeafSize = 8;
  static constexpr std::uint32_t kMaxDepth = 32;

  struct alignas(32) Block {
    float coordinates[kDimensions][kLeafSize];
  };

  HugeVector<PointKdNode> nodes;                    ///< 2^depth - 1
  HugeVector<Block> blocks;                         ///< 2^depth, or none where there are no points
  HugeVector<std::uint32_t> ids;                    ///< kLeafSize a block: numbers of the points; kNoPoint where there is none
  std::array<float, kDimensions> lower{}, upper{};  ///< bounds of all points
  std::uint32_t depth = 0;
  std::uint32_t size = 0;  ///< points in the tree

  static constexpr std::uint32_t kNoPoint = 0xffffffffU;

  [[nodiscard]] std::size_t memory() const {
    return nodes.size() * sizeof(PointKdNode) + blocks.size() * sizeof(Block) + ids.size() * sizeof(std::uint32_t);
  }

  /// The first broken invariant in words, or an empty string: sizes, each point on its side of all nodes above it and within the bounds, each number below
  /// `point_count` at most once. O(size * depth).
  [[nodiscard]] std::string validate(std::size_t point_count) const;
};

}  // namespace grove
