#include "grove/lab/comparison_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "grove/lab/advice.h"
#include "grove/lab/break_even.h"
#include "grove/lab/predictions.h"

namespace grove {
namespace {

using Json = nlohmann::ordered_json;

Json optional_json(const std::optional<double>& figure) {
  return figure ? Json(*figure) : Json(nullptr);
}

Json count_spread_json(const CountSpread& spread) {
  return {{"mean", spread.mean}, {"p95", spread.p95}, {"max", spread.max}};
}

Json update_json(const std::optional<UpdateTrial>& update) {
  if (!update) return nullptr;
  return {{"method", name_of(update->method)}, {"seconds", update->seconds}};
}

Json steps_json(std::span<const StepsBin> bins) {
  Json json = Json::array();
  for (const StepsBin& bin : bins) json.push_back({bin.first, bin.rays});
  return json;
}

Json row_json(const ComparisonRow& row) {
  const auto unless_missing = [](bool present, const Json& value) { return present ? value : Json(nullptr); };
  Json json{
      {"structure", row.structure},
      {"rays", row.rays},
      {"ray_count", row.ray_count},
      {"mrays_per_s", unless_missing(row.is_timed(), spread_json(row.mrays_per_s))},
      {"nodes_per_ray", unless_missing(row.is_counted, row.nodes_per_ray())},
      {"tests_per_ray", unless_missing(row.is_counted, row.tests_per_ray())},
      {"build_seconds", unless_missing(row.is_built(), spread_json(row.build_seconds))},
      {"build_seconds_one_thread", unless_missing(row.build_seconds_one_thread.median > 0.0, spread_json(row.build_seconds_one_thread))},
      {"update", update_json(row.update)},
      {"bytes", unless_missing(row.is_described, row.bytes)},
      {"expected_cost", unless_missing(row.is_described, row.expected_cost)},
      {"end_point_overlap", optional_json(row.end_point_overlap)},
      {"sibling_overlap", optional_json(row.sibling_overlap)},
      {"references", unless_missing(row.is_described, row.references)},
      {"duplication", optional_json(row.duplication)},
      {"nodes", unless_missing(row.is_described, row.nodes)},
      {"leaves", unless_missing(row.is_described, row.leaves)},
      {"depth", unless_missing(row.is_described, row.depth)},
      {"mismatches", unless_missing(row.is_counted, row.mismatches)},
      {"ratio_to_first", unless_missing(row.is_timed() && row.ratio_to_first.median > 0.0, spread_json(row.ratio_to_first))},
      {"work",
       unless_missing(row.is_counted, {{"nodes", count_spread_json(row.work.nodes)}, {"tests", count_spread_json(row.work.tests)}})},
      {"steps_histogram", unless_missing(row.is_counted, steps_json(row.work.steps))}};
  if (!row.error.empty()) json["error"] = row.error;
  return json;
}

Json heat_maps_json(std::span<const HeatMap> maps) {
  Json list = Json::array();
  for (const HeatMap& map : maps) list.push_back({{"structure", map.structure}, {"max", map.max}, {"steps", heat_map_base64(map)}});
  return {{"width", kHeatMapWidth}, {"height", kHeatMapHeight}, {"maps", std::move(list)}};
}

Json break_even_json(std::span<const ComparisonRow> rows) {
  Json list = Json::array();
  for (const BreakEven& one : break_even(rows)) {
    Json curves = Json::array();
    for (const ImageTime& time : one.times)
      curves.push_back({{"structure", time.structure}, {"build_seconds", time.build_seconds}, {"seconds_per_ray", time.seconds_per_ray}});
    Json best = Json::array();
    for (const QuickestFrom& from : one.quickest) best.push_back({{"from_rays", from.rays}, {"structure", from.structure}});
    list.push_back({{"rays", one.rays}, {"curves", std::move(curves)}, {"best", std::move(best)}});
  }
  return list;
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
  Json json{{"format", "grove-compare"},
            {"version", 1},
            {"scene", comparison.scene},
            {"primitives", comparison.primitives},
            {"ray_count", comparison.ray_count},
            {"rounds", comparison.rounds},
            {"complete", comparison.is_complete},
            {"reference_rays", comparison.reference_rays},
            {"machine", machine_json(comparison.machine)},
            {"command", comparison.command},
            {"date", comparison.date},
            {"rows", std::move(rows)},
            {"notes", comparison.notes}};
  json["break_even"] = break_even_json(comparison.rows);
  json["predictions"] = Json::array();
  for (const ReportSection& section : predictions(comparison.rows)) json["predictions"].push_back(section_json(section));
  if (comparison.matched_memory) json["matched_memory"] = section_json(*comparison.matched_memory);
  json["advice"] = Json::array();
  for (const Advice& one : advise(comparison)) json["advice"].push_back({{"use", one.use}, {"structure", one.structure}, {"why", one.why}});
  if (comparison.auto_choice) json["auto"] = {{"structure", comparison.auto_choice->structure}, {"reason", comparison.auto_choice->reason}};
  if (!comparison.heat_maps.empty()) json["heat_maps"] = heat_maps_json(comparison.heat_maps);
  return json;
}

}  // namespace grove
