#pragma once

#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "grove/lab/report_section.h"
#include "grove/lab/workload.h"

namespace grove {

/// A structure in one of its sizes.
struct SizedStructure {
  std::string spec;  ///< canonical
  std::uint64_t bytes = 0;
};

struct MatchedStructure {
  std::string structure;  ///< as it was asked for
  SizedStructure matched;
};

/// Of each structure with a leaf size, the leaf size (1 to 64, by powers of 2) that makes it take about `bytes`, by the ratio; of the others what they are. Builds
/// all of them, one at a time. `brute` is left out. Throws UsageError for a bad spec, and Stopped.
[[nodiscard]] std::vector<MatchedStructure> match_memory(const Scene& scene, std::span<const std::string> specs, std::uint64_t bytes,
                                                         std::stop_token stop = {});

/// Structures at about the same memory, which is the median of what they take as they are asked for: their sizes, work and times of diffuse rays on one thread. All are in
/// memory at once. Throws Error where hits differ, UsageError for a bad spec or camera, InputError where there are no such rays, and Stopped.
[[nodiscard]] ReportSection matched_memory(const Scene& scene, std::span<const std::string> specs, const std::string& camera,
                                           const WorkloadSettings& settings, unsigned rounds, std::stop_token stop = {});

}  // namespace grove
