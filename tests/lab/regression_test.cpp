#include "grove/lab/regression.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "grove/base/random.h"

namespace grove {
namespace {

/// `rows` rows of three figures: 1, and two at random.
std::vector<double> random_causes(std::size_t rows) {
  Random random(11);
  std::vector<double> causes;
  causes.reserve(3 * rows);
  for (std::size_t i = 0; i < rows; ++i) {
    const double a = 40.0 * static_cast<double>(random.next_float());
    const double b = 7.0 * static_cast<double>(random.next_float());
    causes.insert(causes.end(), {1.0, a, b});
  }
  return causes;
}

TEST(FitLinear, FindsThePricesOfValuesThatFollowThem) {
  const std::vector<double> causes = random_causes(20);
  const std::array prices{120.0, 3.5, -2.0};
  std::vector<double> values;
  for (std::size_t i = 0; i < 20; ++i) values.push_back(prices[0] + prices[1] * causes[3 * i + 1] + prices[2] * causes[3 * i + 2]);
  const LinearFit fit = fit_linear(causes, 3, values);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(fit.prices[i], prices.at(i), 1e-9);
  EXPECT_NEAR(fit.r_squared, 1.0, 1e-12);
  EXPECT_NEAR(fit.predict(std::array{1.0, 2.0, 3.0}), 120.0 + 7.0 - 6.0, 1e-9);
}

// What least squares are: what remains has nothing in common with any cause.
TEST(FitLinear, LeavesWhatNoCauseExplains) {
  const std::vector<double> causes = random_causes(50);
  Random random(12);
  std::vector<double> values;
  for (std::size_t i = 0; i < 50; ++i) values.push_back(causes[3 * i + 1] + 10.0 * static_cast<double>(random.next_float()));
  const LinearFit fit = fit_linear(causes, 3, values);
  EXPECT_GT(fit.r_squared, 0.8);
  EXPECT_LT(fit.r_squared, 1.0);
  for (std::size_t cause = 0; cause < 3; ++cause) {
    double common = 0.0;
    for (std::size_t i = 0; i < 50; ++i) {
      const std::span row = std::span(causes).subspan(3 * i, 3);
      common += row[cause] * (values[i] - fit.predict(row));
    }
    EXPECT_NEAR(common, 0.0, 1e-8) << cause;
  }
}

TEST(FitLinear, GivesNothingForACauseThatFollowsFromOthers) {
  std::vector<double> causes;
  std::vector<double> values;
  for (int i = 0; i < 6; ++i) {
    causes.insert(causes.end(), {1.0 * i, 2.0 * i});
    values.push_back(3.0 * i);
  }
  const LinearFit fit = fit_linear(causes, 2, values);
  EXPECT_NEAR(fit.predict(std::array{10.0, 20.0}), 30.0, 1e-9);
  EXPECT_EQ(fit.prices[1], 0.0);
}

// With one price forced to zero, the best that is left is the fit of the other cause alone.
TEST(FitLinear, KeepsPricesFromBecomingNegative) {
  const std::array causes{1.0, 4.0, 2.0, 3.0, 3.0, 1.0, 5.0, 2.0};
  std::vector<double> values;
  double with_values = 0.0;
  double with_itself = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    values.push_back(10.0 * causes.at(2 * i) - causes.at(2 * i + 1));
    with_values += causes.at(2 * i) * values.back();
    with_itself += causes.at(2 * i) * causes.at(2 * i);
  }
  EXPECT_NEAR(fit_linear(causes, 2, values).prices[1], -1.0, 1e-9);
  const LinearFit fit = fit_linear(causes, 2, values, PriceSign::not_negative);
  EXPECT_EQ(fit.prices[1], 0.0);
  EXPECT_NEAR(fit.prices[0], with_values / with_itself, 1e-9);
}

TEST(FitPowerLaw, FindsTheExponent) {
  std::vector<double> x;
  std::vector<double> y;
  for (int i = 1; i < 8; ++i) {
    x.push_back(i * 100.0);
    y.push_back(3.0 * std::pow(i * 100.0, 1.5));
  }
  const PowerLaw law = fit_power_law(x, y);
  EXPECT_NEAR(law.exponent, 1.5, 1e-9);
  EXPECT_NEAR(law.factor, 3.0, 1e-6);
  EXPECT_NEAR(law.r_squared, 1.0, 1e-12);
}

TEST(Correlation, GoesFromMinusOneToOne) {
  const std::array x{1.0, 2.0, 3.0, 4.0};
  EXPECT_NEAR(correlation(x, std::array{2.0, 4.0, 6.0, 8.0}), 1.0, 1e-12);
  EXPECT_NEAR(correlation(x, std::array{3.0, 2.0, 1.0, 0.0}), -1.0, 1e-12);
  EXPECT_NEAR(correlation(x, std::array{1.0, -1.0, -1.0, 1.0}), 0.0, 1e-12);
  EXPECT_EQ(correlation(x, std::array{5.0, 5.0, 5.0, 5.0}), 0.0);
}

TEST(GeometricMean, MultipliesAndTakesTheRoot) {
  EXPECT_NEAR(geometric_mean(std::array{2.0, 8.0}), 4.0, 1e-12);
  EXPECT_EQ(geometric_mean({}), 0.0);
}

}  // namespace
}  // namespace grove
