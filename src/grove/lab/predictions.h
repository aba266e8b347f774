#pragma once

#include <span>
#include <vector>

#include "grove/lab/comparison_row.h"
#include "grove/lab/report_section.h"

namespace grove {

/// How well the cost models of the review foretell the times of a comparison. Equation 5, a ray's time as nodes T_v + tests T_i (and a constant), is fitted to each
/// family's rows by least squares, with prices of at least 0; the expected cost (equation 2 summed over the tree) is held against the times of each kind of rays. Families
/// and kinds with too few timed rows to test a fit are left out; nothing where all are.
[[nodiscard]] std::vector<ReportSection> predictions(std::span<const ComparisonRow> rows);

}  // namespace grove
