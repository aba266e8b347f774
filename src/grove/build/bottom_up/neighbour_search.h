#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "grove/build/primitive_reference.h"

namespace grove {

/// For each of a stretch of boxes, the one at most so many places away whose joint box with it has the least half area.
///
/// Pairs are put in one order, by area, then by distance in places, then by place (with a distance of one, pairs that differ in the last
/// bit of the place first); each box takes the first of its pairs. So the first pair of all is chosen from both sides.
class NeighbourSearch {
 public:
  /// `first_place` is the place of the first box, for the last bit.
  NeighbourSearch(std::span<const PrimitiveReference> boxes, std::size_t first_place, float area_scale);

  /// Measures each pair once, four at a time. At least two boxes. O(n radius).
  void run(std::size_t radius);

  /// The nearest box of box i, counted within the stretch. True for boxes whose neighbours all lie in the stretch.
  [[nodiscard]] std::size_t nearest(std::size_t i) const { return static_cast<std::size_t>(nearest_[i]); }

 private:
  std::size_t count_;
  std::size_t first_place_;
  float area_scale_;
  std::vector<float> bounds_[6];
  std::vector<float> least_;
  std::vector<std::int32_t> nearest_;
};

}  // namespace grove
