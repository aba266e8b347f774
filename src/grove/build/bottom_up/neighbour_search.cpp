#include "grove/build/bottom_up/neighbour_search.h"

#include <algorithm>
#include <limits>

#include "grove/math/float4.h"

namespace grove {
namespace {

Int4 load_ints(const std::int32_t* p) {
  Int4 v;
  std::memcpy(&v, p, sizeof v);
  return v;
}

// Where `mask` is set, takes the new area and partner.
void take(Int4 mask, Float4 area, Int4 partner, float* least, std::int32_t* nearest) {
  const Float4 new_least = mask ? area : load4(least);
  const Int4 new_nearest = mask ? partner : load_ints(nearest);
  std::memcpy(least, &new_least, sizeof new_least);
  std::memcpy(nearest, &new_nearest, sizeof new_nearest);
}

}  // namespace

NeighbourSearch::NeighbourSearch(std::span<const PrimitiveReference> boxes, std::size_t first_place, float area_scale)
    : count_(boxes.size()), first_place_(first_place), area_scale_(area_scale) {
  // Behind the last box stand boxes with which every joint box is infinite, as many as a step of four may reach.
  const std::size_t padded = count_ + 8;
  for (int side = 0; side < 6; ++side) {
    bounds_[side].resize(padded, side < 3 ? -std::numeric_limits<float>::infinity() : std::numeric_limits<float>::infinity());
    for (std::size_t i = 0; i < count_; ++i) bounds_[side][i] = side < 3 ? boxes[i].lower[side] : boxes[i].upper[side - 3];
  }
}

void NeighbourSearch::run(std::size_t radius) {
  const float infinity = std::numeric_limits<float>::infinity();
  least_.assign(count_ + radius + 8, infinity);
  nearest_.resize(count_ + radius + 8);
  // Should all areas be infinite, the place next to it still is a partner.
  for (std::size_t i = 0; i < count_; ++i) {
    const std::size_t other = ((first_place_ + i) & 1U) == 0 ? i + 1 : i - 1;
    nearest_[i] = static_cast<std::int32_t>(other < count_ ? other : (i > 0 ? i - 1 : i));
  }
  const Int4 lanes = {0, 1, 2, 3};
  const Float4 scale = splat(area_scale_);
  // All bits set in the lanes of even places.
  const Int4 even = (first_place_ & 1U) == 0 ? Int4{-1, 0, -1, 0} : Int4{0, -1, 0, -1};
  for (std::size_t distance = 1; distance <= std::min(radius, count_ - 1); ++distance) {
    for (std::size_t i = 0; i + distance < count_; i += 4) {
      Float4 extent[3];
      for (int axis = 0; axis < 3; ++axis) {
        const Float4 lower = min(load4(&bounds_[axis][i]), load4(&bounds_[axis][i + distance]));
        const Float4 upper = max(load4(&bounds_[axis + 3][i]), load4(&bounds_[axis + 3][i + distance]));
        extent[axis] = (upper - lower) * scale;
      }
      const Float4 area = extent[0] * (extent[1] + extent[2]) + extent[1] * extent[2];
      const Int4 places = lanes + static_cast<std::int32_t>(i);
      const auto step = static_cast<std::int32_t>(distance);
      // First the later one of each pair: where both are as good, a box takes the pair that begins before it,
      take(area < load4(&least_[i + distance]), area, places, &least_[i + distance], &nearest_[i + distance]);
      // but next-door neighbours take the pair that begins at an even place.
      const Float4 old = load4(&least_[i]);
      const Int4 is_better = distance == 1 ? (area < old) | ((area == old) & even) : area < old;
      take(is_better, area, places + step, &least_[i], &nearest_[i]);
    }
  }
}

}  // namespace grove
