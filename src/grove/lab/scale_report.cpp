#include "grove/lab/scale_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "grove/lab/claims/figures.h"
#include "grove/lab/comparison_report.h"
#include "grove/lab/text_table.h"

namespace grove {
namespace {

using Json = nlohmann::ordered_json;

Json row_json(const ScaleRow& row) {
  const bool has_figures = row.error.empty();
  const auto unless_missing = [&](const Json& value) { return has_figures ? value : Json(nullptr); };
  Json json{{"structure", row.structure},
            {"primitives", row.primitives},
            {"build_seconds", unless_missing(row.build_seconds.median)},
            {"bytes", unless_missing(row.bytes)},
            {"steps_per_ray", unless_missing(row.steps())},
            {"nodes_per_ray", unless_missing(row.nodes)},
            {"tests_per_ray", unless_missing(row.tests)},
            {"mrays_per_s", unless_missing(row.mrays_per_s.median)}};
  if (!has_figures) json["error"] = row.error;
  return json;
}

Json law_json(const PowerLaw& law) {
  return {{"exponent", law.exponent}, {"factor", law.factor}, {"r_squared", law.r_squared}};
}

/// One line for each structure, over the number of primitives.
ReportSection section_of(const ScaleStudy& study, const std::string& title, const std::string& axis, const auto& point) {
  std::vector<PlotSeries> series;
  for (const ScaleRow& row : study.rows) {
    if (row.error.empty()) add_point(series, row.structure, point(row));
  }
  return {title, "", {}, ReportPlot{PlotKind::line, {"primitives", true}, {axis, true}, series}};
}

std::vector<ReportSection> sections_of(const ScaleStudy& study) {
  const auto size = [](const ScaleRow& row) { return static_cast<double>(row.primitives); };
  const auto plain = [](double x, double y) { return PlotPoint{x, y, y, y}; };
  return {section_of(study, "Building", "seconds", [&](const ScaleRow& row) { return spread_point(size(row), row.build_seconds); }),
          section_of(study, "Memory", "bytes", [&](const ScaleRow& row) { return plain(size(row), static_cast<double>(row.bytes)); }),
          section_of(study, "Steps", "nodes and tests a ray", [&](const ScaleRow& row) { return plain(size(row), row.steps()); }),
          section_of(study, "Rate", "Mrays/s", [&](const ScaleRow& row) { return spread_point(size(row), row.mrays_per_s); })};
}

std::string law_text(const PowerLaw& law) {
  return law.factor > 0.0 ? fmt::format("n^{:.2f} (R² {:.3f})", law.exponent, law.r_squared) : "-";
}

}  // namespace

Json scale_json(const ScaleStudy& study) {
  Json rows = Json::array();
  for (const ScaleRow& row : study.rows) rows.push_back(row_json(row));
  Json fits = Json::array();
  for (const ScaleFit& fit : study.fits)
    fits.push_back(
        {{"structure", fit.structure}, {"build", law_json(fit.build)}, {"memory", law_json(fit.memory)}, {"steps", law_json(fit.steps)}});
  Json sections = Json::array();
  for (const ReportSection& section : sections_of(study)) sections.push_back(section_json(section));
  return {{"format", "grove-scale"},
          {"version", 1},
          {"scene", study.scene},
          {"sizes", study.sizes},
          {"rays", study.rays},
          {"ray_count", study.ray_count},
          {"complete", study.is_complete},
          {"machine", machine_json(study.machine)},
          {"command", study.command},
          {"date", study.date},
          {"rows", std::move(rows)},
          {"fits", std::move(fits)},
          {"sections", std::move(sections)}};
}

std::string scale_text(const ScaleStudy& study) {
  using enum TextTable::Align;
  TextTable table({{"primitives", right},
                   {"structure", left},
                   {"build ms", right},
                   {"memory", right},
                   {"bytes/primitive", right},
                   {"nodes/ray", right},
                   {"tests/ray", right},
                   {"Mrays/s (min–max)", right}});
  std::string failures;
  for (std::size_t i = 0; i < study.rows.size(); ++i) {
    const ScaleRow& row = study.rows[i];
    if (i > 0 && study.rows[i - 1].primitives != row.primitives) table.add_gap();
    const std::string count = with_separators(row.primitives);
    if (!row.error.empty()) {
      table.add_row({count, row.structure, "failed", "-", "-", "-", "-", "-"});
      failures += fmt::format("failed: {} at {} primitives: {}\n", row.structure, count, row.error);
      continue;
    }
    table.add_row({count, row.structure, short_number(1e3 * row.build_seconds.median), byte_size(row.bytes),
                   short_number(static_cast<double>(row.bytes) / static_cast<double>(row.primitives)), short_number(row.nodes),
                   short_number(row.tests), spread_text(row.mrays_per_s)});
  }
  TextTable fits({{"structure", left}, {"build time", left}, {"memory", left}, {"steps a ray", left}});
  for (const ScaleFit& fit : study.fits) fits.add_row({fit.structure, law_text(fit.build), law_text(fit.memory), law_text(fit.steps)});
  return fmt::format("{}: {} {} rays, {} thread{}\n\n{}\n{}\n{}", study.scene, with_separators(study.ray_count), study.rays,
                     study.machine.threads, study.machine.threads == 1 ? "" : "s", table.text(), study.fits.empty() ? "" : fits.text(),
                     failures);
}

}  // namespace grove
