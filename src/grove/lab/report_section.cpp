#include "grove/lab/report_section.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "grove/base/error.h"
#include "grove/lab/text_table.h"

namespace grove {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, 3> kPlotKinds{"line", "scatter", "bar"};

Json axis_json(const PlotAxis& axis) {
  Json json{{"label", axis.label}};
  if (axis.log) json["log"] = true;
  if (!axis.categories.empty()) json["categories"] = axis.categories;
  return json;
}

PlotAxis axis_from_json(const Json& json) {
  return {json.at("label"), json.value("log", false), json.value("categories", std::vector<std::string>())};
}

Json point_json(const PlotPoint& point) {
  Json json{point.x, point.y};
  if (point.y_min != point.y || point.y_max != point.y) json.insert(json.end(), {point.y_min, point.y_max});
  return json;
}

PlotPoint point_from_json(const Json& json) {
  const double y = json.at(1);
  if (json.size() < 4) return {json.at(0), y, y, y};
  return {json.at(0), y, json.at(2), json.at(3)};
}

Json plot_json(const ReportPlot& plot) {
  Json series = Json::array();
  for (const PlotSeries& one : plot.series) {
    Json points = Json::array();
    for (const PlotPoint& point : one.points) points.push_back(point_json(point));
    series.push_back({{"name", one.name}, {"points", std::move(points)}});
  }
  return {{"kind", kPlotKinds.at(static_cast<std::size_t>(plot.kind))},
          {"x", axis_json(plot.x)},
          {"y", axis_json(plot.y)},
          {"series", std::move(series)}};
}

PlotKind plot_kind(const std::string& name) {
  for (std::size_t i = 0; i < kPlotKinds.size(); ++i) {
    if (kPlotKinds[i] == name) return static_cast<PlotKind>(i);
  }
  throw InputError("'" + name + "' is no kind of plot");
}

ReportPlot plot_from_json(const Json& json) {
  ReportPlot plot{plot_kind(json.at("kind")), axis_from_json(json.at("x")), axis_from_json(json.at("y")), {}};
  for (const Json& one : json.at("series")) {
    PlotSeries& series = plot.series.emplace_back(PlotSeries{one.at("name"), {}});
    for (const Json& point : one.at("points")) series.points.push_back(point_from_json(point));
  }
  return plot;
}

Json table_json(const ReportTable& table) {
  Json rows = Json::array();
  for (const std::vector<ReportCell>& row : table.rows) {
    Json cells = Json::array();
    for (const ReportCell& cell : row) std::visit([&](const auto& value) { cells.push_back(value); }, cell);
    rows.push_back(std::move(cells));
  }
  return {{"columns", table.columns}, {"rows", std::move(rows)}};
}

ReportCell cell_from_json(const Json& json) {
  if (json.is_number()) return json.get<double>();
  return json.is_null() ? std::string() : json.get<std::string>();
}

ReportTable table_from_json(const Json& json) {
  ReportTable table{json.at("columns"), {}};
  for (const Json& row : json.at("rows")) {
    std::vector<ReportCell>& cells = table.rows.emplace_back();
    for (const Json& cell : row) cells.push_back(cell_from_json(cell));
  }
  return table;
}

std::string cell_text(const ReportCell& cell) {
  if (const auto* const number = std::get_if<double>(&cell)) return short_number(*number);
  // A bar would end the cell.
  std::string text;
  for (const char c : std::get<std::string>(cell)) text += c == '|' ? std::string("\\|") : std::string(1, c);
  return text;
}

bool is_number(const ReportTable& table, std::size_t column) {
  return !table.rows.empty() && std::holds_alternative<double>(table.rows.front()[column]);
}

std::string table_markdown(const ReportTable& table) {
  std::string text = "|";
  for (const std::string& column : table.columns) text += ' ' + column + " |";
  text += "\n|";
  for (std::size_t i = 0; i < table.columns.size(); ++i) text += is_number(table, i) ? " ---: |" : " --- |";
  for (const std::vector<ReportCell>& row : table.rows) {
    text += "\n|";
    for (const ReportCell& cell : row) text += ' ' + cell_text(cell) + " |";
  }
  return text + '\n';
}

ReportTable table_of(const ReportPlot& plot) {
  ReportTable table{{"", plot.x.label, plot.y.label}, {}};
  for (const PlotSeries& series : plot.series) {
    for (const PlotPoint& point : series.points) {
      const ReportCell x = plot.x.categories.empty() ? ReportCell(point.x) : plot.x.categories.at(static_cast<std::size_t>(point.x));
      table.rows.push_back({series.name, x, point.y});
    }
  }
  return table;
}

}  // namespace

Json section_json(const ReportSection& section) {
  Json json{{"title", section.title}};
  if (!section.text.empty()) json["text"] = section.text;
  if (section.table) json["table"] = table_json(*section.table);
  if (section.plot) json["plot"] = plot_json(*section.plot);
  return json;
}

ReportSection section_from_json(const Json& json) {
  ReportSection section{json.at("title"), json.value("text", "")};
  if (json.contains("table")) section.table = table_from_json(json.at("table"));
  if (json.contains("plot")) section.plot = plot_from_json(json.at("plot"));
  return section;
}

std::string section_markdown(const ReportSection& section, int level) {
  std::string text = fmt::format("{} {}\n\n", std::string(static_cast<std::size_t>(level), '#'), section.title);
  if (!section.text.empty()) text += section.text + "\n\n";
  if (section.table) {
    text += table_markdown(*section.table) + '\n';
  } else if (section.plot) {
    text += table_markdown(table_of(*section.plot)) + '\n';
  }
  return text;
}

}  // namespace grove
