#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "grove/lab/workload.h"
#include "rivals/contender.h"

namespace grove::bench::rivals {

struct MeasureSettings {
  /// Grove's that are asked in every way, the first of which is what others must agree with; `bvh` is asked about single rays beside them.
  std::vector<std::string> structures = {"fast"};
  std::vector<RayKind> kinds;
  std::size_t rays = 200'000;         ///< of each kind
  std::size_t samples_per_pixel = 1;  ///< of primary rays
  int rounds = 5;                     ///< of tracing
  int build_rounds = 3;
  int threads = 1;  ///< what "all" means
};

/// One way of asking a contender about rays of one kind.
struct Way {
  Entrant::Traits contender;
  std::size_t call_size = 1;
  RayKind kind = RayKind::primary;
};

/// How a way's answers compare to those of Grove's first contender, one ray a call.
struct WayAgreement {
  Way way;
  std::size_t rays = 0;
  std::size_t differing = 0;    ///< exact contenders: in any bit. Others: hit or miss, or t by more than 1e-4 relative
  std::size_t unexplained = 0;  ///< closest hits of others that are no matter of rounding (trace/agreement.h)
  bool is_good = false;         ///< and so timed
};

struct WayRate {
  Way way;
  int threads = 1;
  std::vector<double> mrays_per_s;  ///< round by round
};

struct BuildTime {
  Entrant::Traits contender;
  int threads = 1;
  std::vector<double> seconds;  ///< round by round
  double bytes_per_triangle = 0.0;
};

struct SceneResult {
  std::string scene;
  std::size_t triangles = 0;
  std::vector<BuildTime> builds;
  std::vector<WayAgreement> agreements;
  std::vector<WayRate> rates;
};

/// Builds and traces all contenders in rounds, each of which takes all of them in turn, on one pinned thread and on all. A way that does not agree is not timed.
/// Throws what reading the scene throws.
[[nodiscard]] SceneResult measure_scene(const std::string& source, const MeasureSettings& settings);

}  // namespace grove::bench::rivals
