#pragma once

#include <cstdint>

#include "grove/build/volumes/hulls.h"

namespace grove {

/// The farthest points of a set along the seven directions of a 14-sided polytope, both ways: the three axes and the four diagonals. Few points that
/// stand for many when a volume is looked for. Those of a union are among those of its parts.
class ExtremalPoints {
 public:
  static constexpr int kCount = 14;

  /// Of nothing.
  ExtremalPoints();
  /// Of all points of the hulls. O(points).
  explicit ExtremalPoints(const HullRange& hulls);

  /// Takes in another set.
  void grow(const ExtremalPoints& other);

  /// Places 2 i and 2 i + 1 are the two ends of direction i.
  [[nodiscard]] const glm::dvec3& operator[](int i) const { return points_[i]; }

 private:
  double reach_[kCount];
  glm::dvec3 points_[kCount];
};

}  // namespace grove
