#include <fmt/format.h>

#include "grove/lab/comparison_report.h"
#include "grove/lab/text_table.h"

namespace grove {
namespace {

std::string spread_text(const Spread& spread, double scale = 1.0) {
  return fmt::format("{} ({}–{})", short_number(scale * spread.median), short_number(scale * spread.min), short_number(scale * spread.max));
}

std::string optional_text(const std::optional<double>& figure) {
  return figure ? short_number(*figure) : "-";
}

std::string unless_missing(bool present, const std::string& text) {
  return present ? text : "-";
}

/// What does not depend on the rays: one line a structure, from the rows of the first kind.
std::string structures_table(const Comparison& comparison) {
  using enum TextTable::Align;
  TextTable table({{"structure", left},
                   {"build ms (min–max)", right},
                   {"1 thread", right},
                   {"memory", right},
                   {"references", right},
                   {"per primitive", right},
                   {"nodes", right},
                   {"depth", right},
                   {"cost", right},
                   {"EPO", right},
                   {"overlap", right}});
  for (const ComparisonRow& row : comparison.rows) {
    if (row.rays != comparison.rows.front().rays) break;
    const bool has_one_thread = row.build_seconds_one_thread.median > 0.0;
    table.add_row(
        {row.structure, unless_missing(row.is_built(), spread_text(row.build_seconds, 1e3)),
         unless_missing(has_one_thread, short_number(1e3 * row.build_seconds_one_thread.median)),
         unless_missing(row.is_described, byte_size(row.bytes)), unless_missing(row.is_described, with_separators(row.references)),
         optional_text(row.duplication), unless_missing(row.is_described, with_separators(row.nodes)),
         unless_missing(row.is_described, std::to_string(row.depth)), unless_missing(row.is_described, short_number(row.expected_cost)),
         optional_text(row.end_point_overlap), optional_text(row.sibling_overlap)});
  }
  return table.text();
}

std::string rays_table(const Comparison& comparison) {
  using enum TextTable::Align;
  TextTable table({{"rays", left},
                   {"structure", left},
                   {"Mrays/s (min–max)", right},
                   {"x first", right},
                   {"nodes/ray", right},
                   {"95 %", right},
                   {"most", right},
                   {"tests/ray", right},
                   {"95 %", right},
                   {"most", right},
                   {"mismatches", right}});
  for (std::size_t i = 0; i < comparison.rows.size(); ++i) {
    const ComparisonRow& row = comparison.rows[i];
    if (i > 0 && comparison.rows[i - 1].rays != row.rays) table.add_gap();
    const auto count = [&](std::uint64_t number) { return unless_missing(row.is_counted, with_separators(number)); };
    table.add_row({row.rays, row.structure, row.error.empty() ? unless_missing(row.is_timed(), spread_text(row.mrays_per_s)) : "failed",
                   unless_missing(row.is_timed() && row.ratio_to_first.median > 0.0, short_number(row.ratio_to_first.median)),
                   unless_missing(row.is_counted, short_number(row.nodes_per_ray())), count(row.work.nodes.p95), count(row.work.nodes.max),
                   unless_missing(row.is_counted, short_number(row.tests_per_ray())), count(row.work.tests.p95), count(row.work.tests.max),
                   count(row.mismatches)});
  }
  return table.text();
}

/// Failures and what a reader should know, one line each.
std::string remarks(const Comparison& comparison) {
  std::string failures;
  std::string notes;
  for (const ComparisonRow& row : comparison.rows) {
    if (row.structure == "brute" && row.ray_count < comparison.ray_count && row.rays == comparison.rows.front().rays) {
      notes += fmt::format("note: {} traces {} of the {} rays of each kind, evenly chosen\n", row.structure, with_separators(row.ray_count),
                           with_separators(comparison.ray_count));
    }
    if (!row.error.empty()) failures += fmt::format("failed: {} on {} rays: {}\n", row.structure, row.rays, row.error);
  }
  if (comparison.reference_rays < comparison.ray_count) {
    notes += fmt::format(
        "note: brute force answered {} of the {} rays of each kind; the others are checked against the first structure that traces all\n",
        with_separators(comparison.reference_rays), with_separators(comparison.ray_count));
  }
  for (const std::string& note : comparison.notes) notes += "note: " + note + '\n';
  return failures + notes;
}

}  // namespace

std::string comparison_table(const Comparison& comparison) {
  const std::string heading =
      fmt::format("{}: {} primitives, {} rays of each kind, {} round{}, {} thread{}\n\n", comparison.scene,
                  with_separators(comparison.primitives), with_separators(comparison.ray_count), comparison.rounds,
                  comparison.rounds == 1 ? "" : "s", comparison.machine.threads, comparison.machine.threads == 1 ? "" : "s");
  return heading + structures_table(comparison) + '\n' + rays_table(comparison) + '\n' + remarks(comparison);
}

}  // namespace grove
