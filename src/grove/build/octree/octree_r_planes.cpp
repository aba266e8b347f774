#include "grove/build/octree/octree_r_planes.h"

#include <algorithm>
#include <limits>

#include "grove/base/parallel.h"
#include "grove/build/octree/octree_r_candidates.h"
#include "grove/build/octree/octree_r_cost.h"
#include "grove/build/octree/octree_r_joint.h"
#include "grove/build/split.h"

namespace grove {
namespace {

bool is_inside(const Box4& cell, int axis, float position) {
  return cell.lower[axis] < position && position < cell.upper[axis];
}

// What equation 9 says of planes across one axis of a cell.
class AxisCost {
 public:
  AxisCost(const Box4& cell, int axis) : lower_(cell.lower[axis]) {
    const auto side = [&](int i) { return static_cast<double>(cell.upper[i]) - static_cast<double>(cell.lower[i]); };
    space_ = {side(axis), side((axis + 1) % 3), side((axis + 2) % 3)};
  }
  [[nodiscard]] double of(float plane, const DividedCounts& counts) const {
    return expected_tests(space_, static_cast<double>(plane) - lower_, counts);
  }

 private:
  double lower_;
  DividedSpace space_;
};

// How many primitives lie wholly below and above each candidate, by axis in the lanes.
struct SideCounts {
  std::vector<Int4> below, above;

  void count(const CellSet& set, const std::vector<Float4>& planes, std::size_t first, std::size_t last) {
    below.assign(planes.size(), Int4{});
    above.assign(planes.size(), Int4{});
    for (std::size_t i = first; i < last; ++i) {
      const Float4 lower = without_last_lane(set[i].lower);
      const Float4 upper = set[i].upper;
      for (std::size_t k = 0; k < planes.size(); ++k) {
        const Int4 is_below = upper <= planes[k];
        below[k] -= is_below;
        above[k] -= (lower >= planes[k]) & ~is_below;
      }
    }
  }
};

OctantCut choose_candidates(const CellSet& set, const Box4& cell, const OctreeRCandidates& candidates) {
  const std::vector<Float4>& planes = candidates.planes;
  const std::size_t chunk_size = set.size() > kOctreeParallelSize ? kBuildChunkSize : set.size();
  std::vector<SideCounts> chunks((set.size() + chunk_size - 1) / chunk_size);
  parallel_chunks(set.size(), chunk_size,
                  [&](std::size_t id, std::size_t first, std::size_t last) { chunks[id].count(set, planes, first, last); });
  OctantCut cut{cell, cell.upper, 0};
  for (int axis = 0; axis < 3; ++axis) {
    if (candidates.counts[axis] == 0) continue;
    const AxisCost cost(cell, axis);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < candidates.counts[axis]; ++k) {
      DividedCounts counts{0.0, 0.0, 0.0};
      for (const SideCounts& chunk : chunks) {
        counts.below += chunk.below[k][axis];
        counts.above += chunk.above[k][axis];
      }
      counts.across = static_cast<double>(set.size()) - counts.below - counts.above;
      const double tests = cost.of(planes[k][axis], counts);
      if (!(tests < least)) continue;
      least = tests;
      cut.planes[axis] = planes[k][axis];
      cut.axes |= 1U << axis;
    }
  }
  return cut;
}

// Sweeps over all begins and ends across an axis. Returns whether there is a plane inside the cell.
bool choose_event(const CellSet& set, const Box4& cell, int axis, std::vector<float>& ends, float& plane) {
  // Begins, ends, and where primitives lie that have no extent across the axis, one after the other.
  const auto count = static_cast<std::ptrdiff_t>(set.size());
  ends.resize(2 * set.size());
  for (std::size_t i = 0; i < set.size(); ++i) {
    ends[i] = set[i].lower[axis];
    ends[set.size() + i] = set[i].upper[axis];
  }
  for (std::size_t i = 0; i < set.size(); ++i)
    if (ends[i] == ends[set.size() + i]) ends.push_back(ends[i]);
  const auto sort = [&](std::ptrdiff_t first, std::ptrdiff_t last) {
    if (set.size() > kOctreeParallelSize) {
      oneapi::tbb::parallel_sort(ends.begin() + first, ends.begin() + last);
    } else {
      std::sort(ends.begin() + first, ends.begin() + last);
    }
  };
  sort(0, count);
  sort(count, 2 * count);
  sort(2 * count, static_cast<std::ptrdiff_t>(ends.size()));

  const AxisCost cost(cell, axis);
  double least = std::numeric_limits<double>::infinity();
  std::size_t begun = 0;           // primitives that begin below the plane
  std::size_t ended = set.size();  // end of those that end below or in it
  std::size_t flat = 2 * set.size();
  while (ended < 2 * set.size()) {
    const float position = begun < set.size() ? std::min(ends[begun], ends[ended]) : ends[ended];
    while (ended < 2 * set.size() && ends[ended] <= position) ++ended;
    std::size_t flat_here = 0;
    for (; flat < ends.size() && ends[flat] <= position; ++flat) flat_here += ends[flat] == position ? 1 : 0;
    if (is_inside(cell, axis, position)) {
      DividedCounts counts{};
      counts.below = static_cast<double>(ended - set.size());
      counts.above = static_cast<double>(set.size() - begun - flat_here);
      counts.across = static_cast<double>(set.size()) - counts.below - counts.above;
      const double tests = cost.of(position, counts);
      if (tests < least) {
        least = tests;
        plane = position;
      }
    }
    while (begun < set.size() && ends[begun] <= position) ++begun;
  }
  return least < std::numeric_limits<double>::infinity();
}

OctantCut choose_events(const CellSet& set, const Box4& cell, OctreeRPlanes::Scratch& scratch) {
  OctantCut cut{cell, cell.upper, 0};
  for (int axis = 0; axis < 3; ++axis) {
    float plane = 0.0F;
    if (!choose_event(set, cell, axis, scratch.ends[axis], plane)) continue;
    cut.planes[axis] = plane;
    cut.axes |= 1U << axis;
  }
  return cut;
}

}  // namespace

OctantCut OctreeRPlanes::choose(const OctantSource& source, const Box4& cell, std::span<const std::uint32_t> ids, Scratch& scratch) const {
  const CellSet set{source, ids};
  if (search_ == OctreeRSearch::events) return choose_events(set, cell, scratch);
  const bool is_joint = search_ == OctreeRSearch::joint;
  const std::uint32_t count = is_joint ? std::min(candidate_count_, kMostJointCandidates) : candidate_count_;
  const OctreeRCandidates candidates(set, cell, count, scratch.ends);
  return is_joint ? choose_jointly(set, cell, candidates, scratch.grids) : choose_candidates(set, cell, candidates);
}

}  // namespace grove
