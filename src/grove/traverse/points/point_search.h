#pragma once

// Questions to a kd-tree over points: which are nearest, which are within a radius, which are in a box. Exact.
//
// The distance of two points is defined to the bit: the sum, in float and in order of the axes, of the squares of the differences. Of points at one
// distance the lowest number comes first. So all answers are well defined, the same on every machine and for any number of threads, and those of brute force.
// Bounds of distances are sums of the same form whose terms are no larger; rounding is monotonic, so no point is lost to it.
//
// Batches run in parallel in the caller's oneTBB arena. Any number of threads may ask one tree.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "grove/accel/point_kd_tree.h"

namespace grove {

/// A point that was found.
struct PointNeighbour {
  std::uint32_t id = 0xffffffffU;  ///< its number; PointKdTree::kNoPoint where there is none
  float squared_distance = std::numeric_limits<float>::infinity();

  friend bool operator==(const PointNeighbour&, const PointNeighbour&) = default;
};

/// The answers to a batch: of query i those from first[i] up to first[i + 1].
template <typename T>
struct BatchAnswers {
  std::vector<std::size_t> first;
  std::vector<T> found;

  [[nodiscard]] std::span<const T> of(std::size_t query) const { return {found.data() + first[query], first[query + 1] - first[query]}; }
};

/// An axis-aligned box, closed.
template <std::size_t kDimensions>
struct PointRange {
  Point<kDimensions> lower, upper;
};

/// Asks one tree, which must outlive it.
template <std::size_t kDimensions>
class PointSearch {
 public:
  using Query = Point<kDimensions>;

  explicit PointSearch(const PointKdTree<kDimensions>& tree) : tree_(tree) {}

  /// Fills `nearest` with the nearest points, nearest first; where there are fewer points, or the query cannot be used, the rest with none. About O(log n)
  /// for few dimensions; O(n) at worst. Allocates nothing.
  void nearest(const Query& query, std::span<PointNeighbour> nearest) const;
  /// The same for many queries: the `k` nearest of query i begin at nearest[k * i]. There must be room for k times as many as there are queries.
  void nearest(std::span<const Query> queries, std::size_t k, std::span<PointNeighbour> nearest) const;

  /// The points within `radius`: those whose squared distance is at most radius * radius in float. Nearest first; none for a radius that is negative or NaN.
  [[nodiscard]] std::vector<PointNeighbour> within(const Query& query, float radius) const;
  [[nodiscard]] BatchAnswers<PointNeighbour> within(std::span<const Query> queries, float radius) const;

  /// The numbers of the points in a box, ascending; none where the box is empty or has a NaN.
  [[nodiscard]] std::vector<std::uint32_t> in_range(const PointRange<kDimensions>& range) const;
  [[nodiscard]] BatchAnswers<std::uint32_t> in_range(std::span<const PointRange<kDimensions>> ranges) const;

 private:
  const PointKdTree<kDimensions>& tree_;
};

}  // namespace grove
