#include "grove/lab/break_even.h"

#include <algorithm>
#include <limits>
#include <tuple>

namespace grove {
namespace {

/// The lower envelope of lines over the number of rays.
std::vector<QuickestFrom> lower_envelope(std::span<const ImageTime> times) {
  std::vector<QuickestFrom> envelope;
  const auto at_start = [](const ImageTime& time) { return std::tuple(time.build_seconds, time.seconds_per_ray); };
  const ImageTime* now = &*std::ranges::min_element(times, {}, at_start);
  double rays = 0.0;
  while (now != nullptr) {
    envelope.push_back({rays, now->structure});
    const ImageTime* next = nullptr;
    double crossing = std::numeric_limits<double>::infinity();
    for (const ImageTime& other : times) {
      if (!(other.seconds_per_ray < now->seconds_per_ray)) continue;
      const double at = (other.build_seconds - now->build_seconds) / (now->seconds_per_ray - other.seconds_per_ray);
      // Of lines that cross at once, the flattest goes on below the others.
      const bool is_flatter = next != nullptr && at == crossing && other.seconds_per_ray < next->seconds_per_ray;
      if (at < crossing || is_flatter) {
        crossing = at;
        next = &other;
      }
    }
    now = next;
    rays = crossing;
  }
  return envelope;
}

}  // namespace

std::vector<BreakEven> break_even(std::span<const ComparisonRow> rows) {
  std::vector<BreakEven> all;
  for (const ComparisonRow& row : rows) {
    if (!row.is_timed() || !row.is_built()) continue;
    if (all.empty() || all.back().rays != row.rays) all.push_back({row.rays, {}, {}});
    all.back().times.push_back({row.structure, row.build_seconds.median, 1e-9 * row.nanoseconds_per_ray()});
  }
  for (BreakEven& one : all) one.quickest = lower_envelope(one.times);
  return all;
}

}  // namespace grove
