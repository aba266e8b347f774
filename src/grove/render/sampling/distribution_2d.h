#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "grove/math/vector.h"

namespace grove {

/// A piecewise-constant density on the unit square, sampled by inversion (first the row, then the column), which keeps strata together.
class Distribution2D {
 public:
  struct Draw {
    Vec2 point{0.0F};
    float density = 0.0F;  ///< with respect to area on the unit square
  };

  Distribution2D() = default;
  /// `weights` row by row, width * height of them, none negative. When all are 0 the density is uniform.
  Distribution2D(std::span<const float> weights, std::uint32_t width, std::uint32_t height);

  [[nodiscard]] bool is_empty() const { return width_ == 0; }
  [[nodiscard]] Draw draw(const Vec2& u) const;
  /// The density at `point`, whose coordinates are clamped to [0, 1].
  [[nodiscard]] float density(const Vec2& point) const;

 private:
  [[nodiscard]] float cell_density(std::uint32_t x, std::uint32_t y) const;

  std::uint32_t width_ = 0;
  std::uint32_t height_ = 0;
  std::vector<float> row_cumulative_;     // height + 1, from 0 to 1
  std::vector<float> column_cumulative_;  // per row width + 1, from 0 to 1
};

}  // namespace grove
