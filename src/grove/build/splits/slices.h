#pragma once

// How a primitive's parts between parallel planes are bounded, for choosing a plane: all slices in one pass over the primitive instead of a clip
// each. Only the cost of a split rests on these boxes, so they need not be conservative; dividing a reference clips exactly.

#include <algorithm>

#include "grove/build/splits/spatial_bins.h"
#include "grove/geometry/geometry_concept.h"
#include "grove/geometry/triangle_mesh.h"

namespace grove {

/// Grows the boxes of bins [first, last] by the parts of primitive i inside `box`: here by the parts of the box.
template <Geometry G>
void add_slices(const G& /*geometry*/, std::uint32_t /*i*/, const Box4& box, const SpatialGrid& grid, int axis, int first, int last,
                Box4* bins) {
  for (int bin = first; bin <= last; ++bin) {
    Box4 slice = box;
    if (bin > first) slice.lower[axis] = grid.plane(bin);
    if (bin < last) slice.upper[axis] = grid.plane(bin + 1);
    bins[bin].grow(slice);
  }
}

/// For a triangle: its corners, and where its edges cross the planes, each in the bins that it touches.
inline void add_slices(const TriangleMesh& mesh, std::uint32_t i, const Box4& box, const SpatialGrid& grid, int axis, int first, int last,
                       Box4* bins) {
  const Triangle& triangle = mesh.triangles()[i];
  const Float4 corners[3] = {to_float4(mesh.vertices()[triangle.x]), to_float4(mesh.vertices()[triangle.y]),
                             to_float4(mesh.vertices()[triangle.z])};
  Box4 slices[kSpatialBinCount];
  std::fill(slices + first, slices + last + 1, Box4::empty());
  for (int edge = 0; edge < 3; ++edge) {
    Float4 low = corners[edge];
    Float4 high = corners[(edge + 1) % 3];
    if (low[axis] > high[axis]) std::swap(low, high);
    if (high[axis] < grid.plane(first) || low[axis] > grid.plane(last + 1)) continue;
    int bin = first;
    while (bin < last && grid.plane(bin + 1) <= low[axis]) ++bin;
    if (low[axis] >= grid.plane(first)) slices[bin].grow(low);
    const Float4 step = (high - low) * splat(1.0F / (high[axis] - low[axis]));
    // Also the plane below the first bin: a corner outside the box may lie beyond it.
    if (low[axis] < grid.plane(first)) slices[first].grow(low + step * splat(grid.plane(first) - low[axis]));
    for (; bin < last && grid.plane(bin + 1) < high[axis]; ++bin) {
      const Float4 crossing = low + step * splat(grid.plane(bin + 1) - low[axis]);
      slices[bin].grow(crossing);
      slices[bin + 1].grow(crossing);
    }
    if (high[axis] <= grid.plane(last + 1)) {
      slices[bin].grow(high);
    } else {
      slices[last].grow(low + step * splat(grid.plane(last + 1) - low[axis]));
    }
  }
  for (int bin = first; bin <= last; ++bin) {
    // The reference may be a piece: nothing of it lies outside its box. What rounding turns inside out is left away.
    const Box4 slice{max(slices[bin].lower, box.lower), min(slices[bin].upper, box.upper)};
    if (first_three_lanes(slice.lower <= slice.upper) == 7) bins[bin].grow(slice);
  }
}

}  // namespace grove
