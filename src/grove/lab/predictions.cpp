#include "grove/lab/predictions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "grove/lab/claims/figures.h"
#include "grove/lab/regression.h"

namespace grove {
namespace {

/// A constant, nodes and tests; twice as many rows, so that the fit can fail.
constexpr std::size_t kCauses = 3;
constexpr std::size_t kFewestRows = 2 * kCauses;
constexpr std::size_t kFewestForCorrelation = 4;

/// Walks of one family that take steps of different kinds have prices of their own.
std::string family_of(const ComparisonRow& row) {
  std::string family = row.structure.substr(0, row.structure.find(':'));
  for (const char* const form : {"arity=4", "arity=8", "bounds=obb", "bounds=sphere", "walk=neighbour", "walk=ropes"})
    if (row.structure.find(form) != std::string::npos) family += std::string(" ") + form;
  return family;
}

std::array<double, kCauses> causes_of(const ComparisonRow& row) {
  return {1.0, row.nodes_per_ray(), row.tests_per_ray()};
}

PlotPoint timed_point(double x, const ComparisonRow& row) {
  // The fastest round has the shortest time.
  return {x, row.nanoseconds_per_ray(), 1e3 / row.mrays_per_s.max, 1e3 / row.mrays_per_s.min};
}

void fit_family(const std::string& family, std::span<const ComparisonRow* const> rows, ReportTable& fits, std::vector<PlotSeries>& series) {
  std::vector<double> causes;
  std::vector<double> times;
  for (const ComparisonRow* const row : rows) {
    const auto one = causes_of(*row);
    causes.insert(causes.end(), one.begin(), one.end());
    times.push_back(row->nanoseconds_per_ray());
  }
  const LinearFit fit = fit_linear(causes, kCauses, times, PriceSign::not_negative);
  std::vector<double> errors;
  for (const ComparisonRow* const row : rows) {
    const double predicted = std::max(1e-3, fit.predict(causes_of(*row)));
    errors.push_back(std::exp(std::fabs(std::log(predicted / row->nanoseconds_per_ray()))));
    add_point(series, family, timed_point(predicted, *row));
  }
  fits.rows.push_back({family, static_cast<double>(rows.size()), fit.prices[0], fit.prices[1], fit.prices[2], fit.r_squared,
                       percent_more(geometric_mean(errors))});
}

std::optional<ReportSection> equation_5(std::span<const ComparisonRow* const> rows) {
  std::map<std::string, std::vector<const ComparisonRow*>> families;
  for (const ComparisonRow* const row : rows) {
    if (row->structure != "brute") families[family_of(*row)].push_back(row);
  }
  ReportTable fits{{"structures", "rows", "ns a ray", "ns a node (T_v)", "ns a test (T_i)", "R²", "typical error"}, {}};
  std::vector<PlotSeries> series;
  for (const auto& [family, members] : families) {
    if (members.size() >= kFewestRows) fit_family(family, members, fits, series);
  }
  if (fits.rows.empty()) return std::nullopt;
  return ReportSection{"Equation 5: times foretold from nodes and tests",
                       "Time of a ray = constant + nodes T_v + tests T_i, fitted to all kinds of rays of each family; all threads.", fits,
                       ReportPlot{PlotKind::scatter, {"ns a ray foretold", true}, {"ns a ray measured", true}, series}};
}

std::optional<ReportSection> expected_cost(std::span<const ComparisonRow* const> rows) {
  std::map<std::string, std::vector<const ComparisonRow*>> kinds;
  for (const ComparisonRow* const row : rows) {
    // Steps of one kind only: binary hierarchies over boxes.
    if (family_of(*row) == "bvh") kinds[row->rays].push_back(row);
  }
  ReportTable table{{"rays", "rows", "correlation of expected cost and time"}, {}};
  std::vector<PlotSeries> series;
  for (const auto& [kind, members] : kinds) {
    if (members.size() < kFewestForCorrelation) continue;
    std::vector<double> costs;
    std::vector<double> times;
    for (const ComparisonRow* const row : members) {
      costs.push_back(row->expected_cost);
      times.push_back(row->nanoseconds_per_ray());
      add_point(series, kind, timed_point(row->expected_cost, *row));
    }
    table.rows.push_back({kind, static_cast<double>(members.size()), correlation(costs, times)});
  }
  if (table.rows.empty()) return std::nullopt;
  return ReportSection{"Expected cost against time",
                       "Equation 2 summed over the tree, a step as 1 and a test as 0.35, for binary hierarchies over boxes.", table,
                       ReportPlot{PlotKind::scatter, {"expected cost", true}, {"ns a ray measured", true}, series}};
}

}  // namespace

std::vector<ReportSection> predictions(std::span<const ComparisonRow> rows) {
  std::vector<const ComparisonRow*> timed;
  for (const ComparisonRow& row : rows) {
    if (row.is_timed()) timed.push_back(&row);
  }
  std::vector<ReportSection> sections;
  for (std::optional<ReportSection> section : {equation_5(timed), expected_cost(timed)}) {
    if (section) sections.push_back(std::move(*section));
  }
  return sections;
}

}  // namespace grove
