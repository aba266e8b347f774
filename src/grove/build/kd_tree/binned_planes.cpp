#include "grove/build/kd_tree/binned_planes.h"

#include <algorithm>
#include <span>
#include <vector>

#include "grove/base/parallel.h"
#include "grove/build/reference_range.h"
#include "grove/build/splits/spatial_bins.h"

namespace grove {
namespace {

struct Ends {
  std::uint32_t begin[3][kSpatialBinCount] = {};
  std::uint32_t end[3][kSpatialBinCount] = {};

  void add(const SpatialGrid grids[3], std::span<const PrimitiveReference> references) {
    for (const PrimitiveReference& reference : references) {
      for (int axis = 0; axis < 3; ++axis) {
        if (!grids[axis].is_usable()) continue;
        const int first = grids[axis].first_bin(reference.lower[axis]);
        ++begin[axis][first];
        ++end[axis][grids[axis].last_bin(reference.upper[axis], first)];
      }
    }
  }
  void merge(const Ends& other) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int i = 0; i < kSpatialBinCount; ++i) {
        begin[axis][i] += other.begin[axis][i];
        end[axis][i] += other.end[axis][i];
      }
    }
  }
};

Box4 bounds_of(const References& references) {
  if (references.size() > kKdParallelSize) return measure_all(references).bounds;
  return measure(references.data(), 0, static_cast<std::uint32_t>(references.size())).bounds;
}

void count_ends(const References& references, const SpatialGrid grids[3], Ends& ends) {
  if (references.size() <= kKdParallelSize) {
    ends.add(grids, references);
    return;
  }
  std::vector<Ends> chunks((references.size() + kBuildChunkSize - 1) / kBuildChunkSize);
  parallel_chunks(references.size(), kBuildChunkSize, [&](std::size_t id, std::size_t first, std::size_t last) {
    chunks[id].add(grids, std::span(references).subspan(first, last - first));
  });
  for (const Ends& chunk : chunks) ends.merge(chunk);
}

}  // namespace

KdPlane BinnedPlanes::find(const ReferenceSet& set, const Box4& cell, Scratch& /*scratch*/) const {
  const Box4 bounds = bounds_of(set.references);
  const SpatialGrid grids[3] = {SpatialGrid(bounds, 0), SpatialGrid(bounds, 1), SpatialGrid(bounds, 2)};
  Ends ends;
  count_ends(set.references, grids, ends);

  const KdCellCost cost = costs().of(cell);
  const auto total = static_cast<std::uint32_t>(set.references.size());
  KdPlane best;
  const auto consider = [&](int axis, float position, std::uint32_t lower, std::uint32_t upper, Side side_of_flat) {
    if (!is_inside(cell, axis, position)) return;
    const float c = cost.of_plane(axis, position, lower, upper);
    if (c < best.cost) best = {true, axis, position, side_of_flat, c, lower, upper};
  };
  for (int axis = 0; axis < 3; ++axis) {
    if (!grids[axis].is_usable()) {
      // A flat set can still be cut off from the empty space on either side.
      consider(axis, bounds.lower[axis], 0, total, Side::right);
      consider(axis, bounds.upper[axis], total, 0, Side::left);
      continue;
    }
    std::uint32_t begun = 0;
    std::uint32_t ended = 0;
    for (int i = 0; i <= kSpatialBinCount; ++i) {
      // What lies in a border begins in the bin above it, but for the last.
      consider(axis, grids[axis].plane(i), begun, total - ended, i < kSpatialBinCount ? Side::right : Side::left);
      if (i == kSpatialBinCount) break;
      begun += ends.begin[axis][i];
      ended += ends.end[axis][i];
    }
  }
  return best;
}

}  // namespace grove
