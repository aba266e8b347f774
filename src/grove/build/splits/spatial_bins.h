#pragma once

#include <cstdint>

#include "grove/math/float4.h"

namespace grove {

inline constexpr int kSpatialBinCount = 16;

/// The planes between equal bins along one axis of a range's bounds. A bin's borders are given by plane(), and bins are told by comparing
/// with them, so that counting and dividing agree exactly.
class SpatialGrid {
 public:
  SpatialGrid() = default;
  SpatialGrid(const Box4& bounds, int axis);

  [[nodiscard]] float plane(int i) const { return planes_[i]; }
  [[nodiscard]] float width() const { return width_; }
  /// Whether the planes all differ, so that each bin has an extent.
  [[nodiscard]] bool is_usable() const { return is_usable_; }
  /// The bin in which something begins whose lower bound is `lower`: the last one whose lower border is not above it.
  [[nodiscard]] int first_bin(float lower) const;
  /// The bin in which it ends: the first one whose upper border is not below `upper`, but not before `first`.
  [[nodiscard]] int last_bin(float upper, int first) const;

 private:
  float planes_[kSpatialBinCount + 1] = {};
  float width_ = 0.0F;
  float inverse_width_ = 0.0F;
  bool is_usable_ = false;
};

/// The grids along all three axes, an axis a lane: finds the bin of what does not cross a plane.
class SpatialGrids {
 public:
  SpatialGrids(const Box4& bounds, const SpatialGrid grids[3]) : lower_(bounds.lower) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!grids[axis].is_usable()) continue;
      width_[axis] = grids[axis].width();
      inverse_width_[axis] = 1.0F / grids[axis].width();
    }
  }

  /// Lanes where the box surely lies in one bin of a usable grid, and these bins; elsewhere `bin` means nothing.
  [[nodiscard]] Int4 single_bins(const Box4& box, Int4& bin) const {
    bin = __builtin_convertvector((box.lower - lower_) * inverse_width_, Int4);
    // As SpatialGrid::plane, so that the answer is exact.
    const Float4 number = __builtin_convertvector(bin, Float4);
    const Float4 below = lower_ + width_ * number;
    const Float4 above = lower_ + width_ * (number + splat(1.0F));
    return (below <= box.lower) & (box.lower < above) & (box.upper <= above) & (bin >= 0) & (bin < kSpatialBinCount);
  }

 private:
  Float4 lower_;
  Float4 width_{};
  Float4 inverse_width_{};
};

/// Bounds of the parts of references in each bin, how many begin there and how many end there.
struct SpatialBins {
  Box4 box[3][kSpatialBinCount];
  std::uint32_t begin[3][kSpatialBinCount];
  std::uint32_t end[3][kSpatialBinCount];

  void clear();
  void merge(const SpatialBins& other);
};

}  // namespace grove
