#include "grove/lab/ray_work.h"

#include <algorithm>
#include <bit>

namespace grove {
namespace {

CountSpread spread_of_counts(std::vector<std::uint64_t>& counts) {
  if (counts.empty()) return {};
  CountSpread spread;
  double sum = 0.0;
  for (const std::uint64_t count : counts) {
    sum += static_cast<double>(count);
    spread.max = std::max(spread.max, count);
  }
  spread.mean = sum / static_cast<double>(counts.size());
  // The smallest rank r with r >= 0.95 n, counted from 1.
  const std::size_t rank = (counts.size() * 19 + 19) / 20;
  const auto at = counts.begin() + static_cast<std::ptrdiff_t>(rank - 1);
  std::nth_element(counts.begin(), at, counts.end());
  spread.p95 = *at;
  return spread;
}

/// 0, 1, 2, 3, 4, 6, 8, 12, 16, …
std::uint64_t bin_start(std::size_t bin) {
  if (bin < 2) return bin;
  const std::uint64_t power = std::uint64_t{1} << bin / 2;
  return bin % 2 == 0 ? power : power + power / 2;
}

std::size_t bin_of(std::uint64_t steps) {
  if (steps < 2) return steps;
  const auto power = static_cast<std::size_t>(std::bit_width(steps)) - 1;
  const bool is_upper_half = (steps >> (power - 1) & 1U) != 0;
  return 2 * power + (is_upper_half ? 1 : 0);
}

}  // namespace

RayWork work_of(std::span<const TraversalCounts> counts) {
  RayWork work;
  std::vector<std::uint64_t> one(counts.size());
  std::ranges::transform(counts, one.begin(), &TraversalCounts::nodes_visited);
  work.nodes = spread_of_counts(one);
  std::ranges::transform(counts, one.begin(), &TraversalCounts::primitives_tested);
  work.tests = spread_of_counts(one);

  std::vector<std::uint64_t> bins;
  for (const TraversalCounts& count : counts) {
    const std::size_t bin = bin_of(count.nodes_visited + count.primitives_tested);
    if (bin >= bins.size()) bins.resize(bin + 1);
    ++bins[bin];
  }
  const auto first = static_cast<std::size_t>(std::ranges::find_if(bins, [](std::uint64_t rays) { return rays > 0; }) - bins.begin());
  work.steps.reserve(bins.size() - first);
  for (std::size_t bin = first; bin < bins.size(); ++bin) work.steps.push_back({bin_start(bin), bins[bin]});
  return work;
}

}  // namespace grove
