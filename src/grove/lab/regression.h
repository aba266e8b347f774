#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace grove {

/// A figure that is a sum of causes, each with a price: value = price[0] * cause[0] + price[1] * cause[1] + …
struct LinearFit {
  std::vector<double> prices;
  /// The share of the variance of the values about their mean that is explained; below 0 where a constant would do better.
  double r_squared = 0.0;

  [[nodiscard]] double predict(std::span<const double> causes) const;
};

enum class PriceSign : std::uint8_t {
  any,
  not_negative  ///< causes whose price would come out below 0 cost nothing; the best of all such fits
};

/// Least squares (QR by modified Gram-Schmidt). `causes` has `cause_count` figures for each value, one value after the other; causes that depend on others get
/// no price. At least as many values as causes. O(values * causes²), for not_negative 2^causes times that.
[[nodiscard]] LinearFit fit_linear(std::span<const double> causes, std::size_t cause_count, std::span<const double> values,
                                   PriceSign sign = PriceSign::any);

/// y = factor * x^exponent, fitted to the logarithms; `r_squared` is of these.
struct PowerLaw {
  double exponent = 0.0;
  double factor = 0.0;
  double r_squared = 0.0;
};

/// At least two different x; all figures above 0.
[[nodiscard]] PowerLaw fit_power_law(std::span<const double> x, std::span<const double> y);

/// Pearson's coefficient, from -1 to 1; 0 where one of the two does not vary.
[[nodiscard]] double correlation(std::span<const double> x, std::span<const double> y);

/// exp of the mean of the logarithms; 0 for none. All figures above 0.
[[nodiscard]] double geometric_mean(std::span<const double> figures);

}  // namespace grove
