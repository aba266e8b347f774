#include "grove/build/bottom_up/neighbour_search.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "grove/math/float4.h"

namespace grove {
namespace {

// Added to every area, so that the numbers compared are never denormal, which is slow.
constexpr float kLeastArea = 0x1p-100F;
// Above every area that occurs, and below infinity, which with a partner noted in it would be NaN.
constexpr float kMostArea = 0x1p100F;

// A partner `distance` places ahead or behind. Of two equal pairs the one with the lower code is taken.
std::int32_t code(std::size_t distance, int is_second_choice) {
  return static_cast<std::int32_t>(2 * distance) + is_second_choice;
}

void keep_less(Float4 value, float* place) {
  const Float4 least = min(value, load4(place));
  store4(least, place);
}

Float4 with_bits(Float4 value, Int4 bits) {
  return reinterpret_cast<Float4>(reinterpret_cast<Int4>(value) | bits);
}

}  // namespace

NeighbourSearch::NeighbourSearch(std::span<const PrimitiveReference> boxes, std::size_t first_place, float area_scale)
    : count_(boxes.size()), first_place_(first_place) {
  // Behind the last box stand boxes with which every joint box is infinite, as many as a step of four may reach.
  const float infinity = std::numeric_limits<float>::infinity();
  for (int side = 0; side < 6; ++side) {
    bounds_[side].resize(count_ + 8);
    std::fill(bounds_[side].end() - 8, bounds_[side].end(), side < 3 ? -infinity : infinity);
  }
  const Float4 scale = splat(area_scale);
  std::size_t i = 0;
  for (; i + 4 <= count_; i += 4) {
    Float4 lower[4];
    Float4 upper[4];
    for (std::size_t lane = 0; lane < 4; ++lane) {
      lower[lane] = boxes[i + lane].box().lower * scale;
      upper[lane] = boxes[i + lane].upper * scale;
    }
    transpose(lower);
    transpose(upper);
    for (int axis = 0; axis < 3; ++axis) {
      store4(lower[axis], &bounds_[axis][i]);
      store4(upper[axis], &bounds_[axis + 3][i]);
    }
  }
  for (; i < count_; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      bounds_[axis][i] = boxes[i].lower[axis] * area_scale;
      bounds_[axis + 3][i] = boxes[i].upper[axis] * area_scale;
    }
  }
}

void NeighbourSearch::run(std::size_t radius) {
  const auto partner_mask = static_cast<std::int32_t>((std::size_t{1} << std::bit_width(2 * radius + 1)) - 1);
  best_.assign(count_ + radius + 8, kMostArea);
  const Int4 area_mask = ~(Int4{} + partner_mask);
  const Int4 is_odd = (first_place_ & 1U) == 0 ? Int4{0, 1, 0, 1} : Int4{1, 0, 1, 0};
  for (std::size_t distance = 1; distance <= std::min(radius, count_ - 1); ++distance) {
    // A box prefers the pair that begins before it, but of its next-door neighbours the one with which it begins at an even place.
    const Int4 ahead = Int4{} + code(distance, 0) + (distance == 1 ? is_odd : Int4{} + 1);
    const Int4 behind = Int4{} + code(distance, 0) + (distance == 1 ? is_odd : Int4{});
    for (std::size_t i = 0; i + distance < count_; i += 4) {
      Float4 extent[3];
      for (int axis = 0; axis < 3; ++axis) {
        const Float4 lower = min(load4(&bounds_[axis][i]), load4(&bounds_[axis][i + distance]));
        const Float4 upper = max(load4(&bounds_[axis + 3][i]), load4(&bounds_[axis + 3][i + distance]));
        extent[axis] = upper - lower;
      }
      const Float4 area = min(extent[0] * (extent[1] + extent[2]) + extent[1] * extent[2] + splat(kLeastArea), splat(kMostArea));
      const Float4 rounded = reinterpret_cast<Float4>(reinterpret_cast<Int4>(area) & area_mask);
      keep_less(with_bits(rounded, behind), &best_[i + distance]);
      keep_less(with_bits(rounded, ahead), &best_[i]);
    }
  }
  steps_.resize(count_);
  for (std::size_t i = 0; i < count_; ++i) {
    const std::int32_t partner = std::bit_cast<std::int32_t>(best_[i]) & partner_mask;
    const std::int32_t distance = partner >> 1;
    const std::int32_t begins_odd = static_cast<std::int32_t>((first_place_ + i) & 1U);
    // 1 where the partner is the second choice, which for next-door neighbours is ahead from an odd place only.
    const std::int32_t is_ahead = (partner & 1) ^ (distance == 1 ? begins_odd ^ 1 : 0);
    steps_[i] = is_ahead != 0 ? distance : -distance;
  }
}

}  // namespace grove
