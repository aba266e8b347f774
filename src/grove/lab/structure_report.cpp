#include "grove/lab/structure_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "grove/lab/text_table.h"

namespace grove {
namespace {

constexpr std::size_t kMostBars = 24;
constexpr std::size_t kLongestBar = 40;

// 0 where there is nothing to share.
double ratio(std::uint64_t value, std::uint64_t count) {
  return count == 0 ? 0.0 : static_cast<double>(value) / static_cast<double>(count);
}

double mean_leaf_depth(const StructureStatistics& statistics) {
  std::uint64_t sum = 0;
  for (std::size_t depth = 0; depth < statistics.depths.size(); ++depth) sum += depth * statistics.depths[depth];
  return ratio(sum, statistics.leaves);
}

}  // namespace

nlohmann::ordered_json structure_json(std::string_view spec, const StructureStatistics& statistics, unsigned threads) {
  return {{"structure", spec},
          {"primitives", statistics.primitives},
          {"references", statistics.references},
          {"nodes", statistics.nodes},
          {"leaves", statistics.leaves},
          {"depth", statistics.depth},
          {"bytes", statistics.bytes},
          {"build_seconds", statistics.build_seconds},
          {"expected_cost", statistics.expected_cost},
          {"threads", threads},
          {"mean_leaf_size", ratio(statistics.references, statistics.leaves)},
          {"largest_leaf", statistics.largest_leaf},
          {"mean_leaf_depth", mean_leaf_depth(statistics)},
          {"leaf_sizes", statistics.leaf_sizes},
          {"leaf_depths", statistics.depths}};
}

nlohmann::ordered_json quality_json(const StructureQuality& quality) {
  nlohmann::ordered_json json{{"end_point_overlap", nullptr},
                              {"end_point_overlap_error", nullptr},
                              {"end_point_overlap_samples", nullptr},
                              {"sibling_overlap", nullptr},
                              {"duplication", nullptr}};
  if (quality.end_point_overlap) {
    json["end_point_overlap"] = quality.end_point_overlap->value;
    json["end_point_overlap_error"] = quality.end_point_overlap->error;
    json["end_point_overlap_samples"] = quality.end_point_overlap->sample_count;
  }
  if (quality.sibling_overlap) json["sibling_overlap"] = *quality.sibling_overlap;
  if (quality.duplication) json["duplication"] = *quality.duplication;
  return json;
}

std::string structure_text(std::string_view spec, const StructureStatistics& statistics, const StructureQuality& quality,
                           std::optional<double> clustering, unsigned threads) {
  const auto per_primitive = [&](std::uint64_t value) { return ratio(value, statistics.primitives); };
  std::string text;
  const auto add = [&](std::string_view name, const std::string& value) { text += fmt::format("{:<18} {}\n", name, value); };
  add("structure", std::string(spec));
  add("primitives", with_separators(statistics.primitives));
  add("references",
      fmt::format("{}  ({} per primitive)", with_separators(statistics.references), short_number(per_primitive(statistics.references))));
  add("nodes", with_separators(statistics.nodes));
  add("leaves", fmt::format("{}  ({} references on average, {} at most)", with_separators(statistics.leaves),
                            short_number(ratio(statistics.references, statistics.leaves)), with_separators(statistics.largest_leaf)));
  add("depth", fmt::format("{}  ({} on average over leaves)", statistics.depth, short_number(mean_leaf_depth(statistics))));
  add("memory", fmt::format("{}  ({} B per primitive)", byte_size(statistics.bytes), short_number(per_primitive(statistics.bytes))));
  add("built in", fmt::format("{} on {} thread{}", duration(statistics.build_seconds), threads, threads == 1 ? "" : "s"));
  add("expected cost", short_number(statistics.expected_cost));
  if (const auto& overlap = quality.end_point_overlap) {
    add("end-point overlap", fmt::format("{}  (standard error {}, {} points)", short_number(overlap->value), short_number(overlap->error),
                                         with_separators(overlap->sample_count)));
  }
  if (quality.sibling_overlap) add("sibling overlap", short_number(*quality.sibling_overlap));
  if (quality.duplication) add("duplication", short_number(*quality.duplication));
  if (clustering) add("clustering", fmt::format("{}  (1: primitives lie at random)", short_number(*clustering)));
  text += "\nleaves by number of references\n" + histogram_text(statistics.leaf_sizes, true);
  text += "\nleaves by depth\n" + histogram_text(statistics.depths, false);
  return text;
}

std::string histogram_text(std::span<const std::uint64_t> bins, bool last_is_open) {
  const auto is_filled = [](std::uint64_t count) { return count > 0; };
  const auto first = static_cast<std::size_t>(std::find_if(bins.begin(), bins.end(), is_filled) - bins.begin());
  if (first == bins.size()) return "  none\n";
  std::size_t end = bins.size();
  while (bins[end - 1] == 0) --end;

  // Neighbouring bins share a bar when there are too many for one each.
  const std::size_t width = (end - first + kMostBars - 1) / kMostBars;
  struct Bar {
    std::string label;
    std::uint64_t count = 0;
  };
  std::vector<Bar> bars;
  for (std::size_t low = first; low < end; low += width) {
    const std::size_t high = std::min(low + width, end) - 1;
    Bar bar{low == high ? std::to_string(low) : fmt::format("{}-{}", low, high), 0};
    if (last_is_open && high + 1 == bins.size()) bar.label = fmt::format("{}+", low);
    for (std::size_t i = low; i <= high; ++i) bar.count += bins[i];
    bars.push_back(std::move(bar));
  }
  std::uint64_t most = 1;
  std::uint64_t total = 0;
  std::size_t label_width = 0;
  for (const Bar& bar : bars) {
    most = std::max(most, bar.count);
    total += bar.count;
    label_width = std::max(label_width, bar.label.size());
  }
  std::string text;
  for (const Bar& bar : bars) {
    // Rounded up, so that only an empty bin has no bar.
    const auto length = static_cast<std::size_t>((bar.count * kLongestBar + most - 1) / most);
    text += fmt::format("  {:>{}}  {:<{}}  {:>12}  {:5.1f} %\n", bar.label, label_width, std::string(length, '#'), kLongestBar,
                        with_separators(bar.count), 100.0 * static_cast<double>(bar.count) / static_cast<double>(total));
  }
  return text;
}

}  // namespace grove
