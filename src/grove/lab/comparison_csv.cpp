#include <fmt/format.h>

#include "grove/lab/comparison_report.h"

namespace grove {
namespace {

/// In quotes where the text holds what would end the field.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string csv_optional(const std::optional<double>& figure) {
  return figure ? fmt::format("{}", *figure) : "";
}

std::string csv_spread(const Spread& spread) {
  return spread.median > 0.0 ? fmt::format("{},{},{}", spread.median, spread.min, spread.max) : ",,";
}

std::string csv_row(const std::string& scene, const ComparisonRow& row) {
  const auto unless_missing = [](bool present, const auto& figure) { return present ? fmt::format("{}", figure) : std::string(); };
  const std::vector<std::string> fields{csv_field(scene),
                                        row.rays,
                                        csv_field(row.structure),
                                        fmt::format("{}", row.ray_count),
                                        csv_spread(row.is_timed() ? row.mrays_per_s : Spread{}),
                                        unless_missing(row.is_timed() && row.ratio_to_first.median > 0.0, row.ratio_to_first.median),
                                        unless_missing(row.is_counted, row.nodes_per_ray()),
                                        unless_missing(row.is_counted, row.work.nodes.p95),
                                        unless_missing(row.is_counted, row.work.nodes.max),
                                        unless_missing(row.is_counted, row.tests_per_ray()),
                                        unless_missing(row.is_counted, row.work.tests.p95),
                                        unless_missing(row.is_counted, row.work.tests.max),
                                        csv_spread(row.build_seconds),
                                        csv_spread(row.build_seconds_one_thread),
                                        unless_missing(row.is_described, row.bytes),
                                        unless_missing(row.is_described, row.expected_cost),
                                        csv_optional(row.end_point_overlap),
                                        csv_optional(row.sibling_overlap),
                                        unless_missing(row.is_described, row.references),
                                        csv_optional(row.duplication),
                                        unless_missing(row.is_described, row.nodes),
                                        unless_missing(row.is_described, row.leaves),
                                        unless_missing(row.is_described, row.depth),
                                        unless_missing(row.is_counted, row.mismatches),
                                        csv_field(row.error)};
  return fmt::format("{}\n", fmt::join(fields, ","));
}

}  // namespace

std::string comparison_csv(const Comparison& comparison) {
  std::string text =
      "scene,rays,structure,ray_count,mrays_per_s_median,mrays_per_s_min,mrays_per_s_max,ratio_to_first,nodes_per_ray,nodes_p95,nodes_max,"
      "tests_per_ray,tests_p95,tests_max,build_seconds_median,build_seconds_min,build_seconds_max,build_seconds_one_thread_median,"
      "build_seconds_one_thread_min,build_seconds_one_thread_max,bytes,expected_cost,end_point_overlap,sibling_overlap,references,"
      "duplication,nodes,leaves,depth,mismatches,error\n";
  for (const ComparisonRow& row : comparison.rows) text += csv_row(comparison.scene, row);
  return text;
}

}  // namespace grove
