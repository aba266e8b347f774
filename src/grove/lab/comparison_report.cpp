#include "grove/lab/comparison_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace grove {
namespace {

using Json = nlohmann::ordered_json;

Json optional_json(const std::optional<double>& figure) {
  return figure ? Json(*figure) : Json(nullptr);
}

Json row_json(const ComparisonRow& row) {
  const auto unless_missing = [](bool present, const Json& value) { return present ? value : Json(nullptr); };
  Json json{{"structure", row.structure},
            {"rays", name_of(row.rays)},
            {"ray_count", row.ray_count},
            {"mrays_per_s", unless_missing(row.is_timed(), spread_json(row.mrays_per_s))},
            {"nodes_per_ray", unless_missing(row.is_counted(), row.nodes_per_ray)},
            {"tests_per_ray", unless_missing(row.is_counted(), row.tests_per_ray)},
            {"build_seconds", unless_missing(row.is_built(), spread_json(row.build_seconds))},
            {"bytes", unless_missing(row.is_counted(), row.bytes)},
            {"expected_cost", unless_missing(row.is_counted(), row.expected_cost)},
            {"end_point_overlap", optional_json(row.end_point_overlap)},
            {"sibling_overlap", optional_json(row.sibling_overlap)},
            {"references", unless_missing(row.is_counted(), row.references)},
            {"nodes", unless_missing(row.is_counted(), row.nodes)},
            {"leaves", unless_missing(row.is_counted(), row.leaves)},
            {"depth", unless_missing(row.is_counted(), row.depth)},
            {"mismatches", unless_missing(row.is_counted(), row.mismatches)},
            {"ratio_to_first", unless_missing(row.is_timed(), spread_json(row.ratio_to_first))}};
  if (!row.error.empty()) json["error"] = row.error;
  return json;
}

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

std::string csv_spread(bool present, const Spread& spread) {
  return present ? fmt::format("{},{},{}", spread.median, spread.min, spread.max) : ",,";
}

}  // namespace

Json machine_json(const Machine& machine) {
  Json json{{"cpu", machine.cpu}, {"cores", machine.cores}, {"threads", machine.threads}, {"compiler", machine.compiler}};
  if (!machine.commit.empty()) json["commit"] = machine.commit;
  json["os"] = machine.os;
  return json;
}

Json spread_json(const Spread& spread) {
  return {{"median", spread.median}, {"min", spread.min}, {"max", spread.max}};
}

Json comparison_json(const Comparison& comparison) {
  Json rows = Json::array();
  for (const ComparisonRow& row : comparison.rows) rows.push_back(row_json(row));
  return {{"format", "grove-compare"},
          {"version", 1},
          {"scene", comparison.scene},
          {"primitives", comparison.primitives},
          {"ray_count", comparison.ray_count},
          {"rounds", comparison.rounds},
          {"reference_rays", comparison.reference_rays},
          {"machine", machine_json(comparison.machine)},
          {"rows", std::move(rows)},
          {"notes", comparison.notes}};
}

std::string comparison_csv(const Comparison& comparison) {
  std::string text =
      "scene,rays,structure,ray_count,mrays_per_s_median,mrays_per_s_min,mrays_per_s_max,ratio_to_first,nodes_per_ray,tests_per_ray,"
      "build_seconds_median,build_seconds_min,build_seconds_max,bytes,expected_cost,end_point_overlap,sibling_overlap,references,nodes,"
      "leaves,depth,mismatches,error\n";
  for (const ComparisonRow& row : comparison.rows) {
    const std::string ratio = row.is_timed() ? fmt::format("{}", row.ratio_to_first.median) : "";
    const std::string counts = row.is_counted() ? fmt::format("{},{}", row.nodes_per_ray, row.tests_per_ray) : ",";
    const std::string sizes = row.is_counted() ? fmt::format("{},{}", row.bytes, row.expected_cost) : ",";
    const std::string quality = csv_optional(row.end_point_overlap) + ',' + csv_optional(row.sibling_overlap);
    const std::string nodes =
        row.is_counted() ? fmt::format("{},{},{},{},{}", row.references, row.nodes, row.leaves, row.depth, row.mismatches) : ",,,,";
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_field(comparison.scene), name_of(row.rays), csv_field(row.structure),
                        row.ray_count, csv_spread(row.is_timed(), row.mrays_per_s), ratio, counts,
                        csv_spread(row.is_built(), row.build_seconds), sizes, quality, nodes, csv_field(row.error));
  }
  return text;
}

}  // namespace grove
