#pragma once

#include <cstdint>
#include <limits>

#include "grove/build/primitive_reference.h"
#include "grove/build/split.h"

namespace grove {

/// A plane that parts a cell, and what is on its sides.
struct KdPlane {
  bool is_possible = false;
  int axis = 0;
  float position = 0.0F;
  /// Where references go that lie in the plane.
  Side side_of_flat = Side::left;
  float cost = std::numeric_limits<float>::infinity();
  std::uint32_t lower_count = 0;
  std::uint32_t upper_count = 0;  ///< both counts include the references that reach across

  /// left is below. A reference that only touches the plane from one side stays on that side: cells are closed.
  [[nodiscard]] Side side(const PrimitiveReference& reference) const {
    const float lower = reference.lower[axis];
    const float upper = reference.upper[axis];
    if (upper <= position) return lower < position ? Side::left : side_of_flat;
    return lower >= position ? Side::right : Side::both;
  }

  void count(Side side) {
    lower_count += side != Side::right ? 1 : 0;
    upper_count += side != Side::left ? 1 : 0;
  }
};

/// Whether a plane would have something of the cell on both sides.
[[nodiscard]] inline bool is_inside(const Box4& cell, int axis, float position) {
  return cell.lower[axis] < position && position < cell.upper[axis];
}

/// The surface-area cost of parting one cell: a step, and the tests on each side by the chance that a ray that meets the cell meets that side
/// (MacDonald and Booth 1990); less by the bonus where a side is empty (Wald and Havran 2006, equation 6 and lambda).
class KdCellCost {
 public:
  KdCellCost(const Box4& cell, float area_scale, const CostModel& model, float empty_bonus)
      : traversal_(static_cast<float>(model.traversal)),
        intersection_(static_cast<float>(model.intersection)),
        left_by_bonus_(1.0F - empty_bonus) {
    const Float4 side = (cell.upper - cell.lower) * splat(area_scale);
    const float area = side[0] * (side[1] + side[2]) + side[1] * side[2];
    for (int axis = 0; axis < 3; ++axis) {
      const float b = side[(axis + 1) % 3];
      const float c = side[(axis + 2) % 3];
      lower_[axis] = cell.lower[axis];
      upper_[axis] = cell.upper[axis];
      // A cell without area is a line: lengths take the place of areas.
      cap_[axis] = area > 0.0F ? b * c / area : 0.0F;
      per_length_[axis] = area > 0.0F ? (b + c) / area * area_scale : area_scale / side[axis];
    }
  }

  /// In units of CostModel.
  [[nodiscard]] float of_plane(int axis, float position, std::uint32_t lower_count, std::uint32_t upper_count) const {
    const float chance_lower = cap_[axis] + (position - lower_[axis]) * per_length_[axis];
    const float chance_upper = cap_[axis] + (upper_[axis] - position) * per_length_[axis];
    const float cost =
        traversal_ + intersection_ * (chance_lower * static_cast<float>(lower_count) + chance_upper * static_cast<float>(upper_count));
    return lower_count == 0 || upper_count == 0 ? cost * left_by_bonus_ : cost;
  }
  [[nodiscard]] float of_leaf(std::uint32_t count) const { return intersection_ * static_cast<float>(count); }

 private:
  float traversal_, intersection_, left_by_bonus_;
  float lower_[3], upper_[3];
  float cap_[3];         // the share of the area that the two ends of the cell have, which each side has whole
  float per_length_[3];  // and how it grows along the axis
};

/// What all cells of one build share.
struct KdCostContext {
  float area_scale;
  CostModel model;
  float empty_bonus;

  [[nodiscard]] KdCellCost of(const Box4& cell) const { return {cell, area_scale, model, empty_bonus}; }
  /// What the chance of being met is in proportion to: half the area; of a line its length.
  [[nodiscard]] float measure(const Box4& cell) const {
    const float area = scaled_half_area(cell, area_scale);
    if (area > 0.0F) return area;
    const Float4 side = (cell.upper - cell.lower) * splat(area_scale);
    return side[0] + side[1] + side[2];
  }
};

/// From here on a set is worth several tasks.
inline constexpr std::size_t kKdParallelSize = 65536;

}  // namespace grove
