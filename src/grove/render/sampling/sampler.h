#pragma once

#include <cstdint>

#include "grove/math/vector.h"

namespace grove {

/// Sample points as a pure function of seed, pixel, sample number and dimension, so that work may be done in any order.
///
/// Every dimension set (one or two dimensions) is the first two dimensions of Sobol's sequence, Owen-scrambled and taken in an
/// Owen-shuffled order of its own (Burley 2020, "Practical Hash-based Owen Scrambling", section 4, padding; the permutation is that of
/// Laine and Karras 2011, "Stratified Sampling for Stochastic Transparency"). So in each pixel the first 2^k samples of a set are a
/// (0, k, 2)-net in base 2, and sets are independent of each other.
class Sampler {
 public:
  Sampler(std::uint64_t seed, std::uint32_t x, std::uint32_t y, std::uint32_t sample);

  /// Both coordinates in [0, 1), multiples of 2^-24.
  [[nodiscard]] Vec2 sample_2d(std::uint32_t dimension) const;
  /// In [0, 1). Shares the point of `sample_2d(dimension)`: give each use a dimension of its own.
  [[nodiscard]] float sample_1d(std::uint32_t dimension) const;

 private:
  std::uint64_t pixel_hash_;
  std::uint32_t reversed_sample_;
};

}  // namespace grove
