#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "grove/base/progress.h"
#include "grove/lab/machine.h"
#include "grove/lab/regression.h"
#include "grove/lab/spread.h"
#include "grove/lab/workload.h"

namespace grove {

struct ScaleSettings {
  /// A built-in scene without a size, "builtin:NAME" or "builtin:NAME?key=value".
  std::string scene;
  /// Numbers of primitives, at least 1 each; the scene comes as near to them as it can.
  std::vector<std::uint64_t> sizes;
  /// Specs. `brute` traces as many rays as are soon traced.
  std::vector<std::string> structures;
  RayKind rays = RayKind::diffuse;
  WorkloadSettings workload{std::size_t{1} << 16, 1};
  /// Of building and tracing, at least 1; a structure that takes long at a size has fewer.
  unsigned rounds = 3;
  /// Why a structure may not be built over a scene (its name and the spec are given), or nothing. May throw Stopped, and be empty.
  std::function<std::string(const std::string& scene, const std::string& spec)> trial_build;
  std::string command;  ///< that was given; for the reader
};

/// One structure at one size.
struct ScaleRow {
  std::string structure;  ///< canonical spec
  std::uint64_t primitives = 0;
  std::string error;  ///< why there are no figures
  Spread build_seconds;
  std::uint64_t bytes = 0;
  double nodes = 0.0;  ///< visited by an average ray
  double tests = 0.0;  ///< primitives tested by an average ray
  Spread mrays_per_s;

  [[nodiscard]] double steps() const { return nodes + tests; }
};

/// Power laws over the number of primitives, of one structure that has figures at two sizes or more.
struct ScaleFit {
  std::string structure;
  PowerLaw build;   ///< seconds
  PowerLaw memory;  ///< bytes
  PowerLaw steps;   ///< of a ray
};

struct ScaleStudy {
  std::string scene;
  std::vector<std::uint64_t> sizes;  ///< that were asked for
  std::string rays;
  std::size_t ray_count = 0;
  Machine machine;
  std::string command;
  std::string date;            ///< ISO 8601, UTC
  bool is_complete = false;    ///< whether every size is in
  std::vector<ScaleRow> rows;  ///< by size, then in the order of the structures
  std::vector<ScaleFit> fits;
};

/// The sizes 1, 3, 10, 30, … thousand up to `largest`.
[[nodiscard]] std::vector<std::uint64_t> scale_sizes(std::uint64_t largest);
/// Specs that stand for the families, but brute force.
[[nodiscard]] std::vector<std::string> scale_specs();

/// Generates the scene at each size, builds each structure over it and traces the same rays, interleaved round by round; one structure is in memory at a time. Hits are
/// compared with those of the first structure. Runs in the caller's oneTBB arena. A structure that fails at a size has a row that says why, and is not tried at larger
/// ones. `save` is called after each size. Progress counts structures at sizes; when `progress.stop` asks, returns the sizes that are finished. Throws UsageError for a bad
/// spec, or a scene that is not built in or has a size.
[[nodiscard]] ScaleStudy study_scale(const ScaleSettings& settings, const std::function<void(const ScaleStudy&)>& save = {},
                                     const ProgressReporter& progress = {});

}  // namespace grove
