#include "grove/lab/animation_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "grove/lab/comparison_report.h"
#include "grove/lab/spread.h"
#include "grove/lab/text_table.h"

namespace grove {
namespace {

std::string spread_text(const Spread& spread) {
  return fmt::format("{} ({}–{})", short_number(spread.median), short_number(spread.min), short_number(spread.max));
}

// "rotate 60, rebuild 40": how often updates did what.
std::string methods_text(const std::vector<const AnimationRow*>& rows) {
  std::string text;
  for (const UpdateMethod method :
       {UpdateMethod::refit, UpdateMethod::rotate, UpdateMethod::partial_rebuild, UpdateMethod::local, UpdateMethod::rebuild}) {
    const auto times = std::count_if(rows.begin(), rows.end(), [&](const AnimationRow* row) { return row->update.method == method; });
    if (times > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name_of(method), times);
  }
  return text;
}

}  // namespace

std::string animation_table(const Animation& animation) {
  using Align = TextTable::Align;
  TextTable table({{"policy", Align::left},
                   {"update ms", Align::right},
                   {"trace ms", Align::right},
                   {"Mrays/s", Align::right},
                   {"nodes/ray", Align::right},
                   {"tests/ray", Align::right},
                   {"cost growth", Align::right},
                   {"mismatches", Align::right},
                   {"what was done", Align::left}});
  std::vector<UpdatePolicy> policies;
  for (const AnimationRow& row : animation.rows)
    if (row.frame == 0) policies.push_back(row.policy);
  for (const UpdatePolicy policy : policies) {
    std::vector<const AnimationRow*> rows;
    rows.reserve(animation.rows.size());
    for (const AnimationRow& row : animation.rows)
      if (row.policy == policy) rows.push_back(&row);
    const auto spread = [&](const auto& value) {
      std::vector<double> values;
      values.reserve(rows.size());
      for (const AnimationRow* row : rows) values.push_back(value(*row));
      return spread_text(spread_of(values));
    };
    std::uint64_t mismatches = 0;
    for (const AnimationRow* row : rows) mismatches += row->mismatches;
    table.add_row(
        {std::string(name_of(policy)), spread([](const AnimationRow& row) { return 1e3 * row.update.seconds; }),
         spread([](const AnimationRow& row) { return 1e3 * row.trace_seconds; }),
         spread([](const AnimationRow& row) { return row.mrays_per_s; }), spread([](const AnimationRow& row) { return row.nodes_per_ray; }),
         spread([](const AnimationRow& row) { return row.tests_per_ray; }),
         spread([](const AnimationRow& row) { return row.update.cost_growth(); }), std::to_string(mismatches), methods_text(rows)});
  }
  return table.text();
}

nlohmann::ordered_json animation_json(const Animation& animation) {
  nlohmann::ordered_json json{{"scene", animation.scene},
                              {"structure", animation.structure},
                              {"rays", name_of(animation.rays)},
                              {"ray_count", animation.ray_count},
                              {"primitives", animation.primitives},
                              {"machine", machine_json(animation.machine)},
                              {"rows", nlohmann::ordered_json::array()}};
  for (const AnimationRow& row : animation.rows) {
    json["rows"].push_back({{"frame", row.frame},
                            {"time", row.time},
                            {"policy", name_of(row.policy)},
                            {"method", name_of(row.update.method)},
                            {"update_seconds", row.update.seconds},
                            {"trace_seconds", row.trace_seconds},
                            {"mrays_per_s", row.mrays_per_s},
                            {"nodes_per_ray", row.nodes_per_ray},
                            {"tests_per_ray", row.tests_per_ray},
                            {"expected_cost", row.update.cost},
                            {"cost_growth", row.update.cost_growth()},
                            {"rotations", row.update.rotations},
                            {"rebuilt_references", row.update.rebuilt_references},
                            {"mismatches", row.mismatches}});
  }
  return json;
}

std::string animation_csv(const Animation& animation) {
  std::string text =
      "frame,time,policy,method,update_seconds,trace_seconds,mrays_per_s,nodes_per_ray,tests_per_ray,expected_cost,cost_growth,rotations,"
      "rebuilt_references,mismatches\n";
  for (const AnimationRow& row : animation.rows) {
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", row.frame, row.time, name_of(row.policy), name_of(row.update.method),
                        row.update.seconds, row.trace_seconds, row.mrays_per_s, row.nodes_per_ray, row.tests_per_ray, row.update.cost,
                        row.update.cost_growth(), row.update.rotations, row.update.rebuilt_references, row.mismatches);
  }
  return text;
}

}  // namespace grove
