#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "grove/lab/ray_set.h"
#include "grove/lab/recorded_rays.h"
#include "grove/lab/reference.h"

namespace grove {

/// Brute force traces as many rays of each kind as make about this many tests: a tenth of a second on one thread.
inline constexpr std::uint64_t kBruteTests = 10'000'000;

/// Rays that every structure of a comparison is traced with, and the right hits.
struct ComparisonWorkload {
  RaySet set;
  std::string error;  ///< why there are no rays
  std::optional<Reference> reference;
  /// Brute force traces every brute_stride-th ray: `sample`, which is empty where that is all.
  std::size_t brute_stride = 1;
  RaySet sample;

  [[nodiscard]] std::size_t stride_for(const std::string& spec) const { return spec == "brute" ? brute_stride : 1; }
  [[nodiscard]] const RaySet& rays_for(const std::string& spec) const { return stride_for(spec) == 1 ? set : sample; }
};

struct ComparisonWorkloadSettings {
  std::span<const RayKind> kinds;
  WorkloadSettings workload;
  std::string camera;
  /// Ray-primitive tests that checking by brute force may take, for each set of rays.
  std::uint64_t check_budget = 0;
};

/// Makes the rays, one set for each kind and for `recorded` one more for each bounce, and finds out what they hit. `made` is called for each kind, and says
/// whether to go on. Rays that cannot be made leave a workload with the reason. Throws UsageError for a bad camera.
[[nodiscard]] std::vector<ComparisonWorkload> make_workloads(const Scene& scene, const ComparisonWorkloadSettings& settings,
                                                             const std::function<bool()>& made);

}  // namespace grove
