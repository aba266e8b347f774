#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "grove/registry/accelerator.h"

namespace grove {

/// A built structure as `grove inspect` writes it: structure, primitives, references, nodes, leaves, depth, bytes, build_seconds,
/// expected_cost, threads, mean_leaf_size, largest_leaf, mean_leaf_depth, and the histograms leaf_sizes and leaf_depths.
[[nodiscard]] nlohmann::ordered_json structure_json(std::string_view spec, const StructureStatistics& statistics, unsigned threads);

/// What is measured only when asked for: end_point_overlap with its end_point_overlap_error and end_point_overlap_samples, sibling_overlap, duplication.
/// Null where there is no such figure.
[[nodiscard]] nlohmann::ordered_json quality_json(const StructureQuality& quality);

/// The same for people: one line a figure, and the histograms as bars. `clustering` is that of the primitives (clustering.h).
[[nodiscard]] std::string structure_text(std::string_view spec, const StructureStatistics& statistics, const StructureQuality& quality,
                                         std::optional<double> clustering, unsigned threads);

/// A bar for each bin from the first that is not empty to the last; many bins are drawn together in ranges. The last bin reads "n+" when
/// `last_is_open`.
[[nodiscard]] std::string histogram_text(std::span<const std::uint64_t> bins, bool last_is_open);

}  // namespace grove
