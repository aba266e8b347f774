#include "grove/lab/advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <optional>

#include "grove/lab/regression.h"
#include "grove/lab/text_table.h"

namespace grove {
namespace {

/// A picture of a million pixels with a hundred paths of some ten rays each.
constexpr double kOfflineRays = 1e9;
/// A frame of two million pixels, one ray each.
constexpr double kFrameRays = 2e6;
/// Where memory is short, a structure may take this many times as long for a ray as the fastest.
constexpr double kSlowest = 2.0;

/// What the rows say of one structure, whatever the rays.
struct Candidate {
  std::string structure;
  double build_seconds = 0.0;
  double update_seconds = 0.0;
  UpdateMethod update = UpdateMethod::rebuild;
  double seconds_per_ray = 0.0;
  double bytes = 0.0;
};

std::vector<Candidate> candidates_of(const Comparison& comparison) {
  const bool has_recorded =
      std::ranges::any_of(comparison.rows, [](const ComparisonRow& row) { return row.rays == "recorded" && row.is_timed(); });
  std::map<std::string, std::vector<double>> times;
  std::map<std::string, bool> failed;
  std::vector<Candidate> candidates;
  for (const ComparisonRow& row : comparison.rows) {
    if (!row.is_timed() || !row.is_built() || row.structure.starts_with("auto")) {
      failed[row.structure] = true;
      continue;
    }
    // Bounces are parts of what is in "recorded".
    if (row.rays.find('-') != std::string::npos || (has_recorded && row.rays != "recorded")) continue;
    if (!times.contains(row.structure)) {
      candidates.push_back({row.structure, row.build_seconds.median, row.update ? row.update->seconds : row.build_seconds.median,
                            row.update ? row.update->method : UpdateMethod::rebuild, 0.0, static_cast<double>(row.bytes)});
    }
    times[row.structure].push_back(1e-9 * row.nanoseconds_per_ray());
  }
  std::erase_if(candidates, [&](const Candidate& candidate) { return failed.contains(candidate.structure); });
  for (Candidate& candidate : candidates) candidate.seconds_per_ray = geometric_mean(times[candidate.structure]);
  return candidates;
}

std::string rate_text(const Candidate& candidate) {
  return short_number(1e-6 / candidate.seconds_per_ray) + " Mrays/s";
}

/// The candidate with the least of a figure, and what the next best has.
struct Choice {
  const Candidate* best;
  std::string next;  ///< "; the next, NAME, …", or nothing
};

Choice least(const std::vector<Candidate>& candidates, const std::function<double(const Candidate&)>& figure,
             const std::function<std::string(double)>& text) {
  const Candidate* best = nullptr;
  const Candidate* next = nullptr;
  for (const Candidate& one : candidates) {
    if (best == nullptr || figure(one) < figure(*best)) {
      next = best;
      best = &one;
    } else if (next == nullptr || figure(one) < figure(*next)) {
      next = &one;
    }
  }
  return {best, next == nullptr ? std::string() : fmt::format("; next is {} with {}", next->structure, text(figure(*next)))};
}

Advice for_still(const std::vector<Candidate>& candidates, const std::string& use, double rays, const char* what) {
  const auto time = [rays](const Candidate& one) { return one.build_seconds + rays * one.seconds_per_ray; };
  const Choice choice = least(candidates, time, duration);
  return {use, choice.best->structure,
          fmt::format("building takes {} and rays go at {}, so {} take {}{}", duration(choice.best->build_seconds), rate_text(*choice.best),
                      what, duration(time(*choice.best)), choice.next)};
}

Advice for_moving_vertices(const std::vector<Candidate>& candidates) {
  const auto time = [](const Candidate& one) { return one.update_seconds + kFrameRays * one.seconds_per_ray; };
  const Choice choice = least(candidates, time, duration);
  return {"moving vertices", choice.best->structure,
          fmt::format("following the vertices ({}) takes {} and rays go at {}, so a frame of 2 million rays takes {}{}{}",
                      name_of(choice.best->update), duration(choice.best->update_seconds), rate_text(*choice.best),
                      duration(time(*choice.best)), choice.next,
                      choice.best->update == UpdateMethod::refit ? "; refitted boxes get worse with time, see grove animate" : "")};
}

Advice for_moving_objects(const std::vector<Candidate>& candidates, std::uint64_t instances) {
  const Choice choice = least(
      candidates, [](const Candidate& one) { return one.seconds_per_ray; },
      [](double seconds) { return short_number(1e-6 / seconds) + " Mrays/s"; });
  const std::string scene =
      instances > 1 ? fmt::format("only the level over {} instances is built in each frame", with_separators(instances))
                    : std::string("objects that move as a whole are instances, and only the level over them is built in each frame");
  return {"moving objects", choice.best->structure,
          fmt::format("{}, so the rate decides: {}{}", scene, rate_text(*choice.best), choice.next)};
}

Advice for_short_memory(const Comparison& comparison, const std::vector<Candidate>& candidates) {
  const double fastest = std::ranges::min_element(candidates, {}, &Candidate::seconds_per_ray)->seconds_per_ray;
  std::vector<Candidate> quick_enough;
  for (const Candidate& one : candidates) {
    if (one.seconds_per_ray <= kSlowest * fastest) quick_enough.push_back(one);
  }
  const auto text = [](double bytes) { return byte_size(static_cast<std::uint64_t>(bytes)); };
  const Choice choice = least(
      quick_enough, [](const Candidate& one) { return one.bytes; }, text);
  const double primitives = static_cast<double>(std::max<std::uint64_t>(1, comparison.primitives));
  return {"memory-bound", choice.best->structure,
          fmt::format("{} ({} bytes a primitive) at {}, among those with at least half of the best rate{}", text(choice.best->bytes),
                      short_number(choice.best->bytes / primitives), rate_text(*choice.best), choice.next)};
}

}  // namespace

std::vector<Advice> advise(const Comparison& comparison) {
  const std::vector<Candidate> candidates = candidates_of(comparison);
  if (candidates.empty()) return {};
  return {for_still(candidates, "static offline", kOfflineRays, "a billion rays"),
          for_still(candidates, "static interactive", kFrameRays, "2 million rays"), for_moving_vertices(candidates),
          for_moving_objects(candidates, comparison.instances), for_short_memory(comparison, candidates)};
}

}  // namespace grove
