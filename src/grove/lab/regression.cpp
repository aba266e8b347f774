#include "grove/lab/regression.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "grove/base/check.h"

namespace grove {
namespace {

/// A cause whose part that is not explained by those before it is shorter than this part of its length depends on them.
constexpr double kDependent = 1e-9;

double dot(std::span<const double> a, std::span<const double> b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

void subtract(std::vector<double>& from, double factor, std::span<const double> what) {
  for (std::size_t i = 0; i < from.size(); ++i) from[i] -= factor * what[i];
}

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// The columns that `chosen` has a bit for, made orthogonal one after the other; the same steps backwards give the prices.
LinearFit fit_chosen(std::span<const double> causes, std::size_t cause_count, std::span<const double> values, std::uint32_t chosen) {
  const std::size_t n = values.size();
  LinearFit fit;
  fit.prices.assign(cause_count, 0.0);
  std::vector<std::size_t> used;
  std::vector<std::vector<double>> directions;  // of length 1
  std::vector<std::vector<double>> shares;      // shares[k][j]: how much of direction j is in column used[k]
  std::vector<double> heights;                  // of the values along each direction
  std::vector<double> rest(values.begin(), values.end());
  for (std::size_t cause = 0; cause < cause_count; ++cause) {
    if ((chosen >> cause & 1U) == 0) continue;
    std::vector<double> column(n);
    for (std::size_t i = 0; i < n; ++i) column[i] = causes[i * cause_count + cause];
    const double length = std::sqrt(dot(column, column));
    std::vector<double> share;
    for (const std::vector<double>& direction : directions) {
      share.push_back(dot(direction, column));
      subtract(column, share.back(), direction);
    }
    const double left = std::sqrt(dot(column, column));
    if (!(left > kDependent * length)) continue;
    for (double& x : column) x /= left;
    share.push_back(left);
    heights.push_back(dot(column, rest));
    subtract(rest, heights.back(), column);
    used.push_back(cause);
    directions.push_back(std::move(column));
    shares.push_back(std::move(share));
  }
  for (std::size_t k = used.size(); k-- > 0;) {
    double height = heights[k];
    for (std::size_t later = k + 1; later < used.size(); ++later) height -= shares[later][k] * fit.prices[used[later]];
    fit.prices[used[k]] = height / shares[k][k];
  }
  const double mean = mean_of(values);
  double whole = 0.0;
  for (const double value : values) whole += (value - mean) * (value - mean);
  fit.r_squared = whole > 0.0 ? 1.0 - dot(rest, rest) / whole : 1.0;
  return fit;
}

}  // namespace

double LinearFit::predict(std::span<const double> causes) const {
  return dot(prices, causes);
}

LinearFit fit_linear(std::span<const double> causes, std::size_t cause_count, std::span<const double> values, PriceSign sign) {
  GROVE_CHECK(cause_count > 0 && cause_count < 16 && causes.size() == cause_count * values.size() && values.size() >= cause_count);
  const std::uint32_t all = (1U << cause_count) - 1;
  LinearFit best = fit_chosen(causes, cause_count, values, all);
  if (sign == PriceSign::any) return best;
  // The best fit without negative prices is the plain one to some of the causes.
  best = {std::vector<double>(cause_count, 0.0), -std::numeric_limits<double>::infinity()};
  for (std::uint32_t chosen = 1; chosen <= all; ++chosen) {
    LinearFit fit = fit_chosen(causes, cause_count, values, chosen);
    const bool allowed = std::all_of(fit.prices.begin(), fit.prices.end(), [](double price) { return price >= 0.0; });
    if (allowed && fit.r_squared > best.r_squared) best = std::move(fit);
  }
  return best;
}

PowerLaw fit_power_law(std::span<const double> x, std::span<const double> y) {
  std::vector<double> causes;
  std::vector<double> logarithms;
  causes.reserve(2 * x.size());
  logarithms.reserve(y.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    causes.insert(causes.end(), {1.0, std::log(x[i])});
    logarithms.push_back(std::log(y[i]));
  }
  const LinearFit fit = fit_linear(causes, 2, logarithms);
  return {fit.prices[1], std::exp(fit.prices[0]), fit.r_squared};
}

double correlation(std::span<const double> x, std::span<const double> y) {
  const double mean_x = mean_of(x);
  const double mean_y = mean_of(y);
  double xx = 0.0;
  double yy = 0.0;
  double xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    yy += (y[i] - mean_y) * (y[i] - mean_y);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  return xx > 0.0 && yy > 0.0 ? xy / std::sqrt(xx * yy) : 0.0;
}

double geometric_mean(std::span<const double> figures) {
  if (figures.empty()) return 0.0;
  double sum = 0.0;
  for (const double figure : figures) sum += std::log(figure);
  return std::exp(sum / static_cast<double>(figures.size()));
}

}  // namespace grove
