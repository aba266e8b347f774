#include "grove/lab/comparison_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "grove/lab/text_table.h"

namespace grove {
namespace {

using Json = nlohmann::ordered_json;

/// Whether times were taken; an interrupted comparison has rows without.
bool is_timed(const ComparisonRow& row) {
  return row.error.empty() && row.mrays_per_s.median > 0.0;
}
bool is_built(const ComparisonRow& row) {
  return row.build_seconds.median > 0.0;
}
/// Whether the rays were traced at all.
bool is_counted(const ComparisonRow& row) {
  return row.nodes_per_ray + row.tests_per_ray > 0.0 || row.error.empty();
}

std::string spread_text(const Spread& spread, double scale = 1.0) {
  return fmt::format("{} ({}–{})", short_number(scale * spread.median), short_number(scale * spread.min), short_number(scale * spread.max));
}

Json row_json(const ComparisonRow& row) {
  const auto unless_missing = [](bool present, const Json& value) { return present ? value : Json(nullptr); };
  Json json{{"structure", row.structure},
            {"rays", name_of(row.rays)},
            {"ray_count", row.ray_count},
            {"mrays_per_s", unless_missing(is_timed(row), spread_json(row.mrays_per_s))},
            {"nodes_per_ray", unless_missing(is_counted(row), row.nodes_per_ray)},
            {"tests_per_ray", unless_missing(is_counted(row), row.tests_per_ray)},
            {"build_seconds", unless_missing(is_built(row), spread_json(row.build_seconds))},
            {"bytes", unless_missing(is_counted(row), row.bytes)},
            {"expected_cost", unless_missing(is_counted(row), row.expected_cost)},
            {"mismatches", unless_missing(is_counted(row), row.mismatches)},
            {"ratio_to_first", unless_missing(is_timed(row), spread_json(row.ratio_to_first))}};
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

std::string comparison_table(const Comparison& comparison) {
  using enum TextTable::Align;
  TextTable table({{"rays", left},
                   {"structure", left},
                   {"Mrays/s (min–max)", right},
                   {"x first", right},
                   {"nodes/ray", right},
                   {"tests/ray", right},
                   {"build ms (min–max)", right},
                   {"memory", right},
                   {"cost", right},
                   {"mismatches", right}});
  std::string failures;
  std::string samples;
  for (std::size_t i = 0; i < comparison.rows.size(); ++i) {
    const ComparisonRow& row = comparison.rows[i];
    if (i > 0 && comparison.rows[i - 1].rays != row.rays) table.add_gap();
    const auto unless_missing = [](bool present, const std::string& text) { return present ? text : std::string("-"); };
    table.add_row({std::string(name_of(row.rays)), row.structure,
                   row.error.empty() ? unless_missing(is_timed(row), spread_text(row.mrays_per_s)) : "failed",
                   unless_missing(is_timed(row) && row.ratio_to_first.median > 0.0, short_number(row.ratio_to_first.median)),
                   unless_missing(is_counted(row), short_number(row.nodes_per_ray)),
                   unless_missing(is_counted(row), short_number(row.tests_per_ray)),
                   unless_missing(is_built(row), spread_text(row.build_seconds, 1e3)),
                   unless_missing(is_counted(row), byte_size(row.bytes)), unless_missing(is_counted(row), short_number(row.expected_cost)),
                   unless_missing(is_counted(row), with_separators(row.mismatches))});
    if (row.ray_count < comparison.ray_count && row.rays == comparison.rows.front().rays) {
      samples += fmt::format("note: {} traces {} of the {} rays of each kind, evenly chosen\n", row.structure,
                             with_separators(row.ray_count), with_separators(comparison.ray_count));
    }
    if (!row.error.empty()) failures += fmt::format("failed: {} on {} rays: {}\n", row.structure, name_of(row.rays), row.error);
  }
  std::string text = fmt::format("{}: {} primitives, {} rays of each kind, {} round{}, {} thread{}\n\n", comparison.scene,
                                 with_separators(comparison.primitives), with_separators(comparison.ray_count), comparison.rounds,
                                 comparison.rounds == 1 ? "" : "s", comparison.machine.threads, comparison.machine.threads == 1 ? "" : "s");
  text += table.text() + '\n' + failures + samples;
  if (comparison.reference_rays < comparison.ray_count) {
    text += fmt::format(
        "note: brute force answered {} of the {} rays of each kind; the others are checked against the first structure that traces all\n",
        with_separators(comparison.reference_rays), with_separators(comparison.ray_count));
  }
  for (const std::string& note : comparison.notes) text += "note: " + note + '\n';
  return text;
}

Json comparison_json(const Comparison& comparison) {
  Json rows = Json::array();
  for (const ComparisonRow& row : comparison.rows) rows.push_back(row_json(row));
  return {{"scene", comparison.scene},
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
      "build_seconds_median,build_seconds_min,build_seconds_max,bytes,expected_cost,mismatches,error\n";
  for (const ComparisonRow& row : comparison.rows) {
    const std::string ratio = is_timed(row) ? fmt::format("{}", row.ratio_to_first.median) : "";
    const std::string counts = is_counted(row) ? fmt::format("{},{}", row.nodes_per_ray, row.tests_per_ray) : ",";
    const std::string sizes = is_counted(row) ? fmt::format("{},{},{}", row.bytes, row.expected_cost, row.mismatches) : ",,";
    text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", csv_field(comparison.scene), name_of(row.rays), csv_field(row.structure),
                        row.ray_count, csv_spread(is_timed(row), row.mrays_per_s), ratio, counts,
                        csv_spread(is_built(row), row.build_seconds), sizes, csv_field(row.error));
  }
  return text;
}

}  // namespace grove
