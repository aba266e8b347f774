#include "grove/build/splits/spatial.h"

#include <algorithm>
#include <limits>

namespace grove {

Side SpatialSplit::cheapest_side(const PrimitiveReference& reference) const {
  Box4 left_with = whole_left;
  Box4 right_with = whole_right;
  left_with.grow(reference.box());
  right_with.grow(reference.box());
  const float left_area = scaled_half_area(whole_left, area_scale);
  const float right_area = scaled_half_area(whole_right, area_scale);
  const float split_cost = left_area * left_time[0] + right_area * right_time[0];
  const float left_cost = scaled_half_area(left_with, area_scale) * left_time[0] + right_area * right_time[1];
  const float right_cost = left_area * left_time[1] + scaled_half_area(right_with, area_scale) * right_time[0];
  if (left_cost < split_cost && left_cost <= right_cost) return Side::left;
  if (right_cost < split_cost) return Side::right;
  return Side::both;
}

SpatialSplit find_spatial_split(const SpatialBins& bins, const SpatialGrid grids[3], std::uint32_t count, std::uint32_t slack,
                                const SplitContext& context) {
  SpatialSplit best;
  best.cost = std::numeric_limits<float>::infinity();
  best.area_scale = context.area_scale;
  for (int axis = 0; axis < 3; ++axis) {
    if (!grids[axis].is_usable()) continue;
    Box4 right_box[kSpatialBinCount];
    std::uint32_t right_count[kSpatialBinCount];
    Box4 box = Box4::empty();
    std::uint32_t ends = 0;
    for (int i = kSpatialBinCount - 1; i > 0; --i) {
      box.grow(bins.box[axis][i]);
      ends += bins.end[axis][i];
      right_box[i] = box;
      right_count[i] = ends;
    }
    Box4 left = Box4::empty();
    std::uint32_t left_count = 0;
    for (int i = 1; i < kSpatialBinCount; ++i) {
      left.grow(bins.box[axis][i - 1]);
      left_count += bins.begin[axis][i - 1];
      // A side that would hold everything parts nothing.
      if (left_count == 0 || right_count[i] == 0 || left_count == count || right_count[i] == count) continue;
      if (left_count + right_count[i] - count > slack) continue;
      const float cost = scaled_half_area(left, context.area_scale) * context.time(left_count) +
                         scaled_half_area(right_box[i], context.area_scale) * context.time(right_count[i]);
      if (!(cost < best.cost)) continue;
      best.is_possible = true;
      best.is_spatial = true;
      best.unsplits = true;
      best.cost = cost;
      best.axis = axis;
      best.plane = grids[axis].plane(i);
      best.whole_left = left;
      best.whole_right = right_box[i];
      best.left_count = left_count;
      best.right_count = right_count[i];
    }
  }
  for (std::uint32_t less = 0; less < 2; ++less) {
    best.left_time[less] = context.time(best.left_count - std::min(less, best.left_count));
    best.right_time[less] = context.time(best.right_count - std::min(less, best.right_count));
  }
  return best;
}

PrimitiveReference with_box(const PrimitiveReference& reference, const Box& box) {
  return {Float4{box.lower.x, box.lower.y, box.lower.z, reference.lower[3]}, Float4{box.upper.x, box.upper.y, box.upper.z, 0.0F}};
}

}  // namespace grove
