#include "grove/build/octree/octree_r_joint.h"

#include <algorithm>
#include <limits>

namespace grove {
namespace {

// Counts, for each triple of candidates, how many primitives reach into each of the eight octants, by their boxes: a primitive reaches below the planes from some
// candidate on and above them up to some candidate, so that one entry a primitive and octant, summed up along the three axes, gives all counts.
class JointSearch {
 public:
  JointSearch(const CellSet& set, const Box4& cell, const OctreeRCandidates& candidates, std::vector<std::uint32_t> grids[8])
      : cell_(cell), candidates_(candidates), grids_(grids) {
    double whole[3];
    for (int axis = 0; axis < 3; ++axis) {
      count_[axis] = std::max<std::size_t>(candidates.counts[axis], 1);
      for (std::size_t i = 0; i < count_[axis]; ++i) {
        const double plane = position(axis, i);
        sides_[axis][0].push_back(plane - static_cast<double>(cell.lower[axis]));
        sides_[axis][1].push_back(static_cast<double>(cell.upper[axis]) - plane);
      }
      whole[axis] = static_cast<double>(cell.upper[axis]) - static_cast<double>(cell.lower[axis]);
    }
    has_area_ = half_area(whole) > 0.0;
    for (int octant = 0; octant < 8; ++octant) grids_[octant].assign(count_[0] * count_[1] * count_[2], 0);
    for (std::size_t i = 0; i < set.size(); ++i) add(set[i]);
    for (std::uint32_t octant = 0; octant < 8; ++octant)
      for (int axis = 0; axis < 3; ++axis) sum_up(grids_[octant], axis, (octant >> axis & 1U) != 0);
  }

  [[nodiscard]] OctantCut best() const {
    std::size_t at[3] = {0, 0, 0};
    std::size_t best_at[3] = {0, 0, 0};
    double least = std::numeric_limits<double>::infinity();
    for (at[2] = 0; at[2] < count_[2]; ++at[2]) {
      for (at[1] = 0; at[1] < count_[1]; ++at[1]) {
        for (at[0] = 0; at[0] < count_[0]; ++at[0]) {
          const double tests = expected(at);
          if (!(tests < least)) continue;
          least = tests;
          std::copy_n(at, 3, best_at);
        }
      }
    }
    OctantCut cut{cell_, cell_.upper, 0};
    for (int axis = 0; axis < 3; ++axis) {
      if (candidates_.counts[axis] == 0) continue;
      cut.planes[axis] = position(axis, best_at[axis]);
      cut.axes |= 1U << axis;
    }
    return cut;
  }

 private:
  [[nodiscard]] std::size_t index(std::size_t x, std::size_t y, std::size_t z) const { return (z * count_[1] + y) * count_[0] + x; }

  void add(const PrimitiveReference& reference) {
    // The first candidate that the primitive reaches below, and the last that it reaches above, if any.
    std::size_t ends[2][3];
    bool is_met[2][3];
    for (int axis = 0; axis < 3; ++axis) {
      ends[0][axis] = ends[1][axis] = 0;
      is_met[0][axis] = true;
      is_met[1][axis] = false;
      if (candidates_.counts[axis] == 0) continue;
      std::size_t first_below = 0;
      std::size_t above = 0;
      for (std::size_t i = 0; i < count_[axis]; ++i) {
        const float plane = candidates_.planes[i][axis];
        const bool is_above = reference.upper[axis] > plane;
        above += is_above ? 1 : 0;
        first_below += reference.lower[axis] < plane || !is_above ? 0 : 1;
      }
      ends[0][axis] = first_below;
      is_met[0][axis] = first_below < count_[axis];
      ends[1][axis] = above - 1;
      is_met[1][axis] = above > 0;
    }
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
      const std::size_t x = octant & 1U;
      const std::size_t y = octant >> 1U & 1U;
      const std::size_t z = octant >> 2U;
      if (is_met[x][0] && is_met[y][1] && is_met[z][2]) ++grids_[octant][index(ends[x][0], ends[y][1], ends[z][2])];
    }
  }

  // Running sums along an axis: from the lowest candidate on, or from the highest down.
  void sum_up(std::vector<std::uint32_t>& grid, int axis, bool is_downward) const {
    const std::size_t stride = axis == 0 ? 1 : axis == 1 ? count_[0] : count_[0] * count_[1];
    const std::size_t count = count_[axis];
    for (std::size_t first = 0; first < grid.size(); first += stride * count) {
      for (std::size_t i = 1; i < count; ++i) {
        const std::size_t to = first + (is_downward ? count - 1 - i : i) * stride;
        const std::size_t from = first + (is_downward ? count - i : i - 1) * stride;
        for (std::size_t k = 0; k < stride; ++k) grid[to + k] += grid[from + k];
      }
    }
  }

  // Where the axis is not cut, all lies below.
  [[nodiscard]] float position(int axis, std::size_t i) const {
    return candidates_.counts[axis] == 0 ? static_cast<float>(cell_.upper[axis]) : static_cast<float>(candidates_.planes[i][axis]);
  }

  static double half_area(const double side[3]) { return side[0] * (side[1] + side[2]) + side[1] * side[2]; }

  // The tests expected in the octants of a triple, times the area of the cell, or its length where it has no area.
  [[nodiscard]] double expected(const std::size_t at[3]) const {
    const std::size_t triple = index(at[0], at[1], at[2]);
    double sum = 0.0;
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
      double side[3];
      for (std::uint32_t axis = 0; axis < 3; ++axis) side[axis] = sides_[axis][octant >> axis & 1U][at[axis]];
      sum += (has_area_ ? half_area(side) : side[0] + side[1] + side[2]) * grids_[octant][triple];
    }
    return sum;
  }

  const Box4& cell_;
  const OctreeRCandidates& candidates_;
  std::vector<std::uint32_t>* grids_;
  std::size_t count_[3];
  std::vector<double> sides_[3][2];  // of the lower and the upper part, by candidate
  bool has_area_ = false;
};

}  // namespace

OctantCut choose_jointly(const CellSet& set, const Box4& cell, const OctreeRCandidates& candidates, std::vector<std::uint32_t> grids[8]) {
  return JointSearch(set, cell, candidates, grids).best();
}

}  // namespace grove
