#include "grove/build/splits/binned.h"

#include <algorithm>
#include <limits>

namespace grove {
namespace {

float scaled_half_area(const Box4& box, float scale) {
  const Float4 d = (box.upper - box.lower) * splat(scale);
  return d[0] * (d[1] + d[2]) + d[1] * d[2];
}

}  // namespace

BinMapping::BinMapping(const Box4& doubled_centres, std::size_t reference_count) : offset(doubled_centres.lower), scale{} {
  bin_count = static_cast<int>(std::min<std::size_t>(kMaxBinCount, 4 + reference_count / 8));
  for (int axis = 0; axis < 3; ++axis) {
    const float extent = doubled_centres.upper[axis] - doubled_centres.lower[axis];
    // A shade below bin_count, so that the last centre falls into the last bin. Extents whose inverse overflows are left whole.
    const float s = static_cast<float>(bin_count) * (1.0F - 0x1p-20F) / extent;
    if (extent > 0.0F && s <= std::numeric_limits<float>::max()) scale[axis] = s;
  }
}

void Bins::clear(int bin_count) {
  for (int axis = 0; axis < 3; ++axis) {
    std::fill_n(box[axis], bin_count, Box4::empty());
    std::fill_n(count[axis], bin_count, 0U);
  }
}

void Bins::add(const BinMapping& mapping, std::span<const PrimitiveReference> references) {
  for (const PrimitiveReference& reference : references) {
    const Box4 bounds = reference.box();
    const Int4 bin = mapping.bins(bounds.lower + bounds.upper);
    box[0][bin[0]].grow(bounds);
    ++count[0][bin[0]];
    box[1][bin[1]].grow(bounds);
    ++count[1][bin[1]];
    box[2][bin[2]].grow(bounds);
    ++count[2][bin[2]];
  }
}

void Bins::merge(const Bins& other, int bin_count) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < bin_count; ++i) {
      box[axis][i].grow(other.box[axis][i]);
      count[axis][i] += other.count[axis][i];
    }
  }
}

BinnedSplit find_binned_split(const Bins& bins, const BinMapping& mapping, float area_scale) {
  BinnedSplit best;
  best.cost = std::numeric_limits<float>::infinity();
  const int bin_count = mapping.bin_count;
  for (int axis = 0; axis < 3; ++axis) {
    if (!mapping.can_split(axis)) continue;
    float right_cost[kMaxBinCount];
    Box4 right = Box4::empty();
    std::uint32_t right_count = 0;
    for (int i = bin_count - 1; i > 0; --i) {
      right.grow(bins.box[axis][i]);
      right_count += bins.count[axis][i];
      right_cost[i] = right_count > 0 ? scaled_half_area(right, area_scale) * static_cast<float>(right_count) : 0.0F;
    }
    Box4 left = Box4::empty();
    std::uint32_t left_count = 0;
    const std::uint32_t total = right_count + bins.count[axis][0];
    for (int i = 1; i < bin_count; ++i) {
      left.grow(bins.box[axis][i - 1]);
      left_count += bins.count[axis][i - 1];
      if (left_count == 0 || left_count == total) continue;
      const float cost = scaled_half_area(left, area_scale) * static_cast<float>(left_count) + right_cost[i];
      if (cost < best.cost) {
        best.axis = axis;
        best.bin = i;
        best.cost = cost;
        best.left = left;
        best.left_count = left_count;
      }
    }
  }
  if (best.axis >= 0) {
    best.right = Box4::empty();
    for (int i = best.bin; i < bin_count; ++i) best.right.grow(bins.box[best.axis][i]);
  }
  return best;
}

}  // namespace grove
