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
  /// Whether the planes all differ, so that each bin has an extent.
  [[nodiscard]] bool is_usable() const { return is_usable_; }
  /// The bin in which something begins whose lower bound is `lower`: the last one whose lower border is not above it.
  [[nodiscard]] int first_bin(float lower) const;
  /// The bin in which it ends: the first one whose upper border is not below `upper`, but not before `first`.
  [[nodiscard]] int last_bin(float upper, int first) const;

 private:
  float planes_[kSpatialBinCount + 1] = {};
  float inverse_width_ = 0.0F;
  bool is_usable_ = false;
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
