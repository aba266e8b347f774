#include "grove/build/splits/spatial_median.h"

#include <algorithm>

#include "grove/build/splits/measure_sides.h"

namespace grove {

PlaneSplit SpatialMedianHeuristic::find(const ReferenceRange& range, std::span<const PrimitiveReference> references,
                                        Scratch& /*scratch*/) const {
  const Float4 extent = range.bounds.upper - range.bounds.lower;
  int axes[3] = {0, 1, 2};
  std::stable_sort(axes, axes + 3, [&](int a, int b) { return extent[a] > extent[b]; });
  for (const int axis : axes) {
    const float plane = range.bounds.lower[axis] + range.bounds.upper[axis];
    if (!(range.centres.lower[axis] < plane && range.centres.upper[axis] >= plane)) continue;
    PlaneSplit split;
    split.axis = axis;
    split.doubled_plane = plane;
    measure_sides(split, references, context_, kBuildChunkSize);
    return split;
  }
  return {};
}

PlaneSplit SpatialMedianHeuristic::find_in_parallel(const ReferenceRange& range, std::span<const PrimitiveReference> references) const {
  Scratch scratch;
  return find(range, references, scratch);
}

}  // namespace grove
