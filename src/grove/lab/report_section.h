#pragma once

// Figures of a report as data: tables and plots that the terminal, Markdown and the HTML report draw each in its way.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace grove {

using ReportCell = std::variant<std::string, double>;

struct ReportTable {
  std::vector<std::string> columns;
  std::vector<std::vector<ReportCell>> rows;  ///< each as long as `columns`
};

struct PlotPoint {
  double x = 0.0;  ///< on an axis with categories: the number of one
  double y = 0.0;
  double y_min = y;  ///< the spread, where it is one
  double y_max = y;
};

struct PlotSeries {
  std::string name;
  std::vector<PlotPoint> points;
};

struct PlotAxis {
  std::string label;
  bool log = false;
  std::vector<std::string> categories = {};
};

enum class PlotKind : std::uint8_t { line, scatter, bar };

struct ReportPlot {
  PlotKind kind = PlotKind::line;
  PlotAxis x;
  PlotAxis y;
  std::vector<PlotSeries> series;
};

/// One figure with its heading: text, a table, a plot, or several of them.
struct ReportSection {
  std::string title;
  std::string text = {};
  std::optional<ReportTable> table = {};
  std::optional<ReportPlot> plot = {};
};

/// The shape is in docs/command-line.md; what is missing is left out.
[[nodiscard]] nlohmann::ordered_json section_json(const ReportSection& section);
/// Back from the same shape. Throws nlohmann::json::exception where it is another one.
[[nodiscard]] ReportSection section_from_json(const nlohmann::ordered_json& json);

/// Heading of that level, text and table in Markdown. A plot without a table becomes a table of its points.
[[nodiscard]] std::string section_markdown(const ReportSection& section, int level);

}  // namespace grove
