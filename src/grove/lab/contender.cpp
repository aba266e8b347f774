#include "grove/lab/contender.h"

#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <exception>
#include <numeric>
#include <utility>

#include "grove/base/error.h"
#include "grove/base/timer.h"
#include "grove/lab/structure_trial.h"

namespace grove {
namespace {

/// A rate is measured over at least this long, by tracing the same rays again, so that the clock's steps do not show.
constexpr double kShortestMeasurement = 0.02;
/// Building on one thread is timed until it has taken this long: on large scenes it takes as long as all else, and varies less.
constexpr double kOneThreadSeconds = 1.0;
/// Rays that are counted between looks at the time limit.
constexpr std::size_t kRaysPerLook = std::size_t{1} << 15;
/// Brute force draws no picture of more tests than this, which take some seconds.
constexpr std::uint64_t kMostHeatMapTests = 2'000'000'000;

/// Traces one part of a set, a few rays at a time.
void count_part(const Accelerator& accelerator, Query query, std::span<const Ray> rays, std::span<Hit> hits,
                std::span<TraversalCounts> counts, double time_limit, const Timer& timer) {
  for (std::size_t first = 0; first < rays.size(); first += kRaysPerLook) {
    if (time_limit > 0.0 && timer.seconds() > time_limit)
      throw Error(fmt::format("tracing takes longer than the time limit of {} s", time_limit));
    const std::size_t count = std::min(kRaysPerLook, rays.size() - first);
    trace_counted(accelerator, query, rays.subspan(first, count), hits.subspan(first, count), counts.subspan(first, count));
  }
}

}  // namespace

Contender::Contender(const std::string& spec, std::span<const ComparisonWorkload> workloads)
    : spec_(spec), rows_(workloads.size()), rates_(workloads.size()) {
  for (std::size_t i = 0; i < workloads.size(); ++i) {
    rows_[i].structure = spec_;
    rows_[i].rays = workloads[i].set.name;
    rows_[i].ray_count = workloads[i].rays_for(spec_).size();
    rows_[i].error = workloads[i].error;
  }
}

void Contender::check(const Scene& scene, std::span<ComparisonWorkload> workloads, const ContenderCheck& settings) {
  try {
    if (settings.trial_build) error_ = settings.trial_build(spec_);
    if (!error_.empty()) return;
    trace_all(scene, workloads, settings);
    // The structure is gone by now: two at once might be too much.
    const std::optional<UpdateTrial> update = try_update(scene, spec_);
    for (ComparisonRow& row : rows_) row.update = update;
  } catch (const std::exception& exception) {
    error_ = reason_of(exception);
  }
}

void Contender::trace_all(const Scene& scene, std::span<ComparisonWorkload> workloads, const ContenderCheck& settings) {
  const SceneAccelerator accelerator(scene, spec_);
  ComparisonRow known;
  describe_structure(accelerator, known);
  for (std::size_t i = 0; i < workloads.size(); ++i) {
    ComparisonRow row = known;
    row.structure = spec_;
    row.rays = rows_[i].rays;
    row.ray_count = rows_[i].ray_count;
    row.error = workloads[i].error;
    if (row.error.empty()) count(accelerator.top(), workloads[i], settings.time_limit, row);
    rows_[i] = std::move(row);
    if (settings.traced) settings.traced(workloads[i]);
  }
  const bool is_dear = spec_ == "brute" && scene.primitive_count() * kHeatMapWidth * kHeatMapHeight > kMostHeatMapTests;
  if (settings.heat_map_camera != nullptr && !is_dear) heat_map_ = draw_heat_map(spec_, accelerator.top(), *settings.heat_map_camera);
}

void Contender::count(const Accelerator& accelerator, ComparisonWorkload& workload, double time_limit, ComparisonRow& row) const {
  const RaySet& set = workload.rays_for(spec_);
  std::vector<Hit> hits(set.size());
  std::vector<TraversalCounts> counts(set.size());
  const std::span all_hits(hits);
  const std::span all_counts(counts);
  const std::size_t border = set.closest_count;
  const Timer timer;
  count_part(accelerator, Query::closest, set.closest(), all_hits.first(border), all_counts.first(border), time_limit, timer);
  count_part(accelerator, Query::any, set.any(), all_hits.subspan(border), all_counts.subspan(border), time_limit, timer);
  row.work = work_of(counts);
  const std::size_t stride = workload.stride_for(spec_);
  const bool rounds = rounds_hits(spec_);
  row.mismatches = rounds ? workload.reference->count_far_off(hits, stride) : workload.reference->count_mismatches(hits, stride);
  row.is_counted = true;
  // A test that rounds may lose hits at edges.
  const std::uint64_t allowed = rounds ? hits.size() / 1000 : 0;
  if (row.mismatches > allowed) {
    row.error = fmt::format("{} of {} hits are not the reference's", row.mismatches, hits.size());
  }
}

void Contender::time(const Scene& scene, std::span<const ComparisonWorkload> workloads,
                     const std::function<void(const ComparisonWorkload&)>& traced) {
  if (!error_.empty()) return;
  try {
    const bool has_one_thread = oneapi::tbb::this_task_arena::max_concurrency() == 1;
    const double spent = std::accumulate(one_thread_seconds_.begin(), one_thread_seconds_.end(), 0.0);
    if (!has_one_thread && spent < kOneThreadSeconds) one_thread_seconds_.push_back(build_on_one_thread(scene));
    const Timer timer;
    const SceneAccelerator accelerator(scene, spec_);
    build_seconds_.push_back(timer.seconds());
    if (has_one_thread) one_thread_seconds_.push_back(build_seconds_.back());
    for (std::size_t i = 0; i < workloads.size(); ++i) {
      rates_[i].push_back(rows_[i].error.empty() ? rate(accelerator.top(), workloads[i].rays_for(spec_)) : 0.0);
      if (traced) traced(workloads[i]);
    }
  } catch (const std::exception& exception) {
    error_ = reason_of(exception);
  }
}

double Contender::build_on_one_thread(const Scene& scene) const {
  oneapi::tbb::task_arena arena(1);
  return arena.execute([&] {
    const Timer timer;
    const SceneAccelerator accelerator(scene, spec_);
    return timer.seconds();
  });
}

/// Millions of rays a second.
double Contender::rate(const Accelerator& accelerator, const RaySet& rays) {
  hits_.resize(rays.size());
  const Timer timer;
  std::size_t repeats = 0;
  do {
    trace(accelerator, rays, hits_);
    ++repeats;
  } while (timer.seconds() < kShortestMeasurement);
  return 1e-6 * static_cast<double>(repeats * rays.size()) / timer.seconds();
}

std::optional<ComparisonRow> Contender::row(std::size_t workload, const Contender& first) const {
  ComparisonRow row = rows_[workload];
  if (row.error.empty()) row.error = error_;
  if (!row.is_counted && row.error.empty()) return std::nullopt;
  row.build_seconds = spread_of(build_seconds_);
  row.build_seconds_one_thread = spread_of(one_thread_seconds_);
  if (!row.update && row.is_built()) row.update = UpdateTrial{UpdateMethod::rebuild, row.build_seconds.median};
  if (!row.error.empty()) return row;
  row.mrays_per_s = spread_of(rates_[workload]);
  // Where the first has wrong hits it has no rates.
  if (first.rows_[workload].error.empty()) row.ratio_to_first = spread_of(ratios_by_round(rates_[workload], first.rates_[workload]));
  return row;
}

}  // namespace grove
