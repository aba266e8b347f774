#include <fmt/format.h>

#include "grove/lab/advice.h"
#include "grove/lab/break_even.h"
#include "grove/lab/comparison_report.h"
#include "grove/lab/text_table.h"

namespace grove {
namespace {

/// A section's table for the terminal.
std::string section_text(const ReportSection& section) {
  std::string text = section.title + "\n" + section.text + "\n";
  if (!section.table) return text;
  std::vector<TextTable::Column> columns;
  for (const std::string& column : section.table->columns)
    columns.push_back({column, columns.size() < 2 ? TextTable::Align::left : TextTable::Align::right});
  TextTable table(std::move(columns));
  for (const std::vector<ReportCell>& row : section.table->rows) {
    std::vector<std::string> cells;
    cells.reserve(row.size());
    for (const ReportCell& cell : row)
      cells.push_back(std::holds_alternative<double>(cell) ? short_number(std::get<double>(cell)) : std::get<std::string>(cell));
    table.add_row(std::move(cells));
  }
  return text + '\n' + table.text() + '\n';
}

std::string break_even_text(const Comparison& comparison) {
  using enum TextTable::Align;
  TextTable table({{"rays", left}, {"quickest to build and trace them, from how many rays on", left}});
  bool has_rows = false;
  for (const BreakEven& one : break_even(comparison.rows)) {
    if (one.times.size() < 2) continue;
    std::string line;
    for (const QuickestFrom& from : one.quickest) {
      if (!line.empty()) line += ", from " + with_separators(static_cast<std::uint64_t>(from.rays)) + ' ';
      line += from.structure;
    }
    table.add_row({one.rays, line});
    has_rows = true;
  }
  return has_rows ? table.text() + '\n' : std::string();
}

}  // namespace

std::string comparison_advice(const Comparison& comparison) {
  std::string text = break_even_text(comparison);
  if (comparison.matched_memory) text += section_text(*comparison.matched_memory);
  const std::vector<Advice> advice = advise(comparison);
  if (!advice.empty()) text += "advice for this scene, from the figures above\n";
  for (const Advice& one : advice) text += fmt::format("  {}: {}\n    {}\n", one.use, one.structure, one.why);
  if (comparison.auto_choice)
    text += fmt::format("  auto, without building any: {}\n    {}\n", comparison.auto_choice->structure, comparison.auto_choice->reason);
  return text;
}

}  // namespace grove
