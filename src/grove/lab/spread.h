#pragma once

#include <vector>

namespace grove {

/// How repeated measurements of one thing lie: what every timed figure is reported as.
struct Spread {
  double median = 0.0;  ///< of an even number of values: the mean of the middle two
  double min = 0.0;
  double max = 0.0;

  friend bool operator==(const Spread&, const Spread&) = default;
};

/// All zero when there are no values.
[[nodiscard]] Spread spread_of(std::vector<double> values);

}  // namespace grove
