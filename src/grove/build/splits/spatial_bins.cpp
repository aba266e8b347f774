#include "grove/build/splits/spatial_bins.h"

#include <algorithm>
#include <limits>

namespace grove {

SpatialGrid::SpatialGrid(const Box4& bounds, int axis) {
  const float lower = bounds.lower[axis];
  const float upper = bounds.upper[axis];
  const float width = (upper - lower) / static_cast<float>(kSpatialBinCount);
  for (int i = 0; i < kSpatialBinCount; ++i) planes_[i] = lower + width * static_cast<float>(i);
  planes_[kSpatialBinCount] = upper;
  width_ = width;
  inverse_width_ = 1.0F / width;
  is_usable_ = width > 0.0F && inverse_width_ <= std::numeric_limits<float>::max();
  for (int i = 0; i < kSpatialBinCount; ++i) is_usable_ = is_usable_ && planes_[i] < planes_[i + 1];
}

int SpatialGrid::first_bin(float lower) const {
  int bin = std::clamp(static_cast<int>((lower - planes_[0]) * inverse_width_), 0, kSpatialBinCount - 1);
  // The guess may be off by one for rounding.
  while (bin > 0 && planes_[bin] > lower) --bin;
  while (bin < kSpatialBinCount - 1 && planes_[bin + 1] <= lower) ++bin;
  return bin;
}

int SpatialGrid::last_bin(float upper, int first) const {
  int bin = std::clamp(static_cast<int>((upper - planes_[0]) * inverse_width_), first, kSpatialBinCount - 1);
  while (bin > first && planes_[bin] >= upper) --bin;
  while (bin < kSpatialBinCount - 1 && planes_[bin + 1] < upper) ++bin;
  return bin;
}

void SpatialBins::clear() {
  for (int axis = 0; axis < 3; ++axis) {
    std::fill_n(box[axis], kSpatialBinCount, Box4::empty());
    std::fill_n(begin[axis], kSpatialBinCount, 0U);
    std::fill_n(end[axis], kSpatialBinCount, 0U);
  }
}

void SpatialBins::merge(const SpatialBins& other) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < kSpatialBinCount; ++i) {
      box[axis][i].grow(other.box[axis][i]);
      begin[axis][i] += other.begin[axis][i];
      end[axis][i] += other.end[axis][i];
    }
  }
}

}  // namespace grove
