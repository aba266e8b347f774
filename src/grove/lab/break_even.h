#pragma once

#include <span>
#include <string>
#include <vector>

#include "grove/lab/comparison_row.h"

namespace grove {

/// Time to image: building and then tracing n rays takes build_seconds + n * seconds_per_ray.
struct ImageTime {
  std::string structure;
  double build_seconds = 0.0;
  double seconds_per_ray = 0.0;

  [[nodiscard]] double seconds(double rays) const { return build_seconds + rays * seconds_per_ray; }
};

/// From how many rays on a structure is the quickest.
struct QuickestFrom {
  double rays = 0.0;
  std::string structure;
};

/// All structures on one kind of rays.
struct BreakEven {
  std::string rays;
  std::vector<ImageTime> times;        ///< of rows with times, in their order
  std::vector<QuickestFrom> quickest;  ///< by rising number of rays; the first from 0
};

/// By kind of rays, from medians. Kinds without a timed row are left out.
[[nodiscard]] std::vector<BreakEven> break_even(std::span<const ComparisonRow> rows);

}  // namespace grove
