#include "grove/build/octree/octree_r_candidates.h"

#include <algorithm>
#include <limits>

#include "grove/base/parallel.h"

namespace grove {

float object_median(const CellSet& set, const Box4& cell, int axis, std::vector<float>& ends) {
  ends.resize(2 * set.size());
  for (std::size_t i = 0; i < set.size(); ++i) {
    ends[2 * i] = std::max<float>(set[i].lower[axis], cell.lower[axis]);
    ends[2 * i + 1] = std::min<float>(set[i].upper[axis], cell.upper[axis]);
  }
  const auto middle = ends.begin() + static_cast<std::ptrdiff_t>(set.size());
  std::nth_element(ends.begin(), middle, ends.end());
  return *middle;
}

OctreeRCandidates::OctreeRCandidates(const CellSet& set, const Box4& cell, std::uint32_t count, std::vector<float> ends[3])
    : planes(count, splat(std::numeric_limits<float>::quiet_NaN())) {
  float medians[3];
  const auto find = [&](std::size_t axis) { medians[axis] = object_median(set, cell, static_cast<int>(axis), ends[axis]); };
  if (set.size() > kOctreeParallelSize) {
    parallel_for(3, 1, find);
  } else {
    for (std::size_t axis = 0; axis < 3; ++axis) find(axis);
  }
  for (int axis = 0; axis < 3; ++axis) {
    const float middle = 0.5F * cell.lower[axis] + 0.5F * cell.upper[axis];
    const float from = std::min(middle, medians[axis]);
    const float to = std::max(middle, medians[axis]);
    float last = cell.lower[axis];
    for (std::uint32_t i = 0; i < count; ++i) {
      const float share = count > 1 ? static_cast<float>(i) / static_cast<float>(count - 1) : 0.5F;
      const float plane = from * (1.0F - share) + to * share;
      if (!(last < plane && plane < cell.upper[axis])) continue;
      planes[counts[axis]++][axis] = last = plane;
    }
  }
}

}  // namespace grove
