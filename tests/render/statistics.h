#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace grove::testing {

/// The chance of a chi-squared statistic at least this large with `degrees` degrees of freedom (Wilson and Hilferty 1931: the cube root is
/// nearly normal; good to a few percent of the chance from 10 degrees on).
inline double chi_squared_tail(double statistic, double degrees) {
  const double spread = 2.0 / (9.0 * degrees);
  const double z = (std::cbrt(statistic / degrees) - (1.0 - spread)) / std::sqrt(spread);
  return 0.5 * std::erfc(z / std::sqrt(2.0));
}

/// Pearson's test of counts against expectations; cells that expect less than 5 are pooled. Returns the chance of a fit as bad as this.
inline double chi_squared_fit(const std::vector<double>& observed, const std::vector<double>& expected) {
  double statistic = 0.0;
  double pooled_observed = 0.0;
  double pooled_expected = 0.0;
  int cells = 0;
  for (std::size_t i = 0; i < observed.size(); ++i) {
    if (expected[i] < 5.0) {
      pooled_observed += observed[i];
      pooled_expected += expected[i];
      continue;
    }
    statistic += (observed[i] - expected[i]) * (observed[i] - expected[i]) / expected[i];
    ++cells;
  }
  if (pooled_expected > 5.0) {
    statistic += (pooled_observed - pooled_expected) * (pooled_observed - pooled_expected) / pooled_expected;
    ++cells;
  } else if (pooled_observed > 25.0) {
    return 0.0;  // much where next to nothing may be
  }
  return cells > 1 ? chi_squared_tail(statistic, cells - 1) : 1.0;
}

}  // namespace grove::testing
