#pragma once

#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "grove/lab/batch.h"
#include "grove/registry/accelerator.h"
#include "grove/scene/scene.h"

namespace grove {

/// One structure of several that were built over the same scene and traced with the same rays, in turn.
struct StructureTrial {
  std::string structure;  ///< canonical spec
  StructureStatistics statistics;
  double nodes = 0.0;                 ///< visited by an average ray
  double tests = 0.0;                 ///< primitives tested by an average ray
  std::vector<double> build_seconds;  ///< by round
  std::vector<double> nanoseconds;    ///< of an average ray, by round

  [[nodiscard]] double steps() const { return nodes + tests; }
};

struct TrialSettings {
  Query query = Query::closest;
  unsigned rounds = 5;         ///< of tracing; at least 1
  unsigned build_rounds = 1;   ///< at least 1
  unsigned threads = 1;        ///< that trace; one is kept on one core
  unsigned build_threads = 0;  ///< that build; 0: those of the caller's oneTBB arena
  std::stop_token stop = {};
};

/// Thrown where `stop` asks in the middle of an experiment.
struct Stopped {};

/// Builds all structures, round by round, then traces all rays with each of them, round by round; every round takes at least 20 ms. All hits must be those of the
/// first structure, bit for bit: a mismatch throws Error. All structures are in memory at once. Throws UsageError for a
/// bad spec, and Stopped.
[[nodiscard]] std::vector<StructureTrial> try_structures(const Scene& scene, std::span<const std::string> specs, std::span<const Ray> rays,
                                                         const TrialSettings& settings = {});

/// Of each round that both have: the figure of `other` over that of `base`.
[[nodiscard]] std::vector<double> ratios_by_round(std::span<const double> other, std::span<const double> base);

}  // namespace grove
