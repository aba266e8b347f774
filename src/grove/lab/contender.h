#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "grove/lab/comparison_row.h"
#include "grove/lab/comparison_workload.h"
#include "grove/lab/heat_map.h"

namespace grove {

/// What checking a contender may take and is to find out.
struct ContenderCheck {
  /// Why a structure may not be built, or nothing; asked before it is built. May throw Stopped, and be empty.
  std::function<std::string(const std::string& spec)> trial_build;
  /// Seconds that tracing one set of rays may take; 0 for any.
  double time_limit = 0.0;
  /// Draws a heat map for this camera.
  const Camera* heat_map_camera = nullptr;
  /// Called when one set of rays has been traced.
  std::function<void(const ComparisonWorkload&)> traced;
};

/// One structure of a comparison: a row for each set of rays, and the measurements that they are made from.
class Contender {
 public:
  Contender(const std::string& spec, std::span<const ComparisonWorkload> workloads);

  /// Builds once, checks every hit, counts what each ray does, and refits once. What is wrong or over a limit is not timed.
  void check(const Scene& scene, std::span<ComparisonWorkload> workloads, const ContenderCheck& settings);

  /// Builds once more, on all threads and in the first rounds on one as well, and traces each set of rays, for the clock.
  void time(const Scene& scene, std::span<const ComparisonWorkload> workloads,
            const std::function<void(const ComparisonWorkload&)>& traced);

  /// The row of a set of rays as far as it is known: empty before `check`. `first` is what ratios are to.
  [[nodiscard]] std::optional<ComparisonRow> row(std::size_t workload, const Contender& first) const;
  [[nodiscard]] const std::optional<HeatMap>& heat_map() const { return heat_map_; }

 private:
  void trace_all(const Scene& scene, std::span<ComparisonWorkload> workloads, const ContenderCheck& settings);
  void count(const Accelerator& accelerator, ComparisonWorkload& workload, double time_limit, ComparisonRow& row) const;
  [[nodiscard]] double build_on_one_thread(const Scene& scene) const;
  [[nodiscard]] double rate(const Accelerator& accelerator, const RaySet& rays);

  std::string spec_;
  std::string error_;
  std::vector<double> build_seconds_;
  std::vector<double> one_thread_seconds_;
  std::vector<ComparisonRow> rows_;
  std::vector<std::vector<double>> rates_;  // of each workload, by round; 0 where the round gave none
  std::optional<HeatMap> heat_map_;
  std::vector<Hit> hits_;
};

}  // namespace grove
