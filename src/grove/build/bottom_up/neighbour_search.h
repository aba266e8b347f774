#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "grove/build/primitive_reference.h"

namespace grove {

/// For each of a stretch of boxes, the one at most so many places away whose joint box with it has the least half area.
///
/// Pairs are put in one order, by area, then by distance in places, then by place (with a distance of one, pairs that begin at an even place
/// first); each box takes the first of its pairs. So the first pair of all is chosen from both sides. Areas are compared without their last bits,
/// where the partner is noted: area and partner are then one number, and the better of two one instruction (Benthin et al. 2022).
class NeighbourSearch {
 public:
  /// `first_place` is the place of the first box, for its last bit. Areas times the square of `area_scale` must be at most 4.
  NeighbourSearch(std::span<const PrimitiveReference> boxes, std::size_t first_place, float area_scale);

  /// Measures each pair once, four at a time. At least two boxes; a radius from 1 to kMostRadius. O(n radius).
  void run(std::size_t radius);

  /// The nearest box of box i, counted within the stretch. True for boxes whose neighbours all lie in the stretch.
  [[nodiscard]] std::size_t nearest(std::size_t i) const { return i + static_cast<std::size_t>(static_cast<std::ptrdiff_t>(steps_[i])); }

  static constexpr std::size_t kMostRadius = 64;

 private:
  std::size_t count_;
  std::size_t first_place_;
  std::vector<float> bounds_[6];     // scaled
  std::vector<float> best_;          // area and partner of each box
  std::vector<std::int32_t> steps_;  // from each box to its partner
};

}  // namespace grove
