#include "grove/build/octree/octree_r_joint.h"

#include <algorithm>
#include <limits>

#include "grove/build/octree/octree_r_cost.h"

namespace grove {
namespace {

// Counts, for each triple of candidates, how many primitives reach into each of the eight octants, by their boxes: a primitive reaches below the planes from some
// candidate on and above them up to some candidate, so that one entry a primitive and octant, summed up along the three axes, gives all counts.
class JointSearch {
 public:
  JointSearch(const CellSet& set, const Box4& cell, const OctreeRCandidates& candidates, std::vector<std::uint32_t> grids[8])
      : cell_(cell), candidates_(candidates), grids_(grids) {
    for (int axis = 0; axis < 3; ++axis) count_[axis] = std::max<std::size_t>(candidates.counts[axis], 1);
    for (int octant = 0; octant < 8; ++octant) grids_[octant].assign(count_[0] * count_[1] * count_[2], 0);
    for (std::size_t i = 0; i < set.size(); ++i) add(set[i]);
    for (std::uint32_t octant = 0; octant < 8; ++octant)
      for (int axis = 0; axis < 3; ++axis) sum_up(grids_[octant], axis, (octant >> axis & 1U) != 0);
  }

  [[nodiscard]] OctantCut best() const {
    OctantCut cut{cell_, cell_.upper, 0};
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t z = 0; z < count_[2]; ++z) {
      for (std::size_t y = 0; y < count_[1]; ++y) {
        for (std::size_t x = 0; x < count_[0]; ++x) {
          OctantCut tried{cell_, cell_.upper, 0};
          const std::size_t at[3] = {x, y, z};
          for (int axis = 0; axis < 3; ++axis) {
            if (candidates_.counts[axis] == 0) continue;
            tried.planes[axis] = candidates_.planes[at[axis]][axis];
            tried.axes |= 1U << axis;
          }
          if (tried.axes == 0) return cut;
          const double tests = expected(tried, index(x, y, z));
          if (!(tests < least)) continue;
          least = tests;
          cut = tried;
        }
      }
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
    for (std::size_t k = 0; k < grid.size(); ++k) {
      const std::size_t i = is_downward ? grid.size() - 1 - k : k;
      const std::size_t at = i / stride % count_[axis];
      if (is_downward ? at + 1 < count_[axis] : at > 0) grid[i] += grid[is_downward ? i + stride : i - stride];
    }
  }

  [[nodiscard]] double expected(const OctantCut& tried, std::size_t triple) const {
    double tests = 0.0;
    for (std::uint32_t octant = 0; octant < 8; ++octant) tests += chance_of_octant(tried, octant) * grids_[octant][triple];
    return tests;
  }

  const Box4& cell_;
  const OctreeRCandidates& candidates_;
  std::vector<std::uint32_t>* grids_;
  std::size_t count_[3];
};

}  // namespace

OctantCut choose_jointly(const CellSet& set, const Box4& cell, const OctreeRCandidates& candidates, std::vector<std::uint32_t> grids[8]) {
  return JointSearch(set, cell, candidates, grids).best();
}

}  // namespace grove
