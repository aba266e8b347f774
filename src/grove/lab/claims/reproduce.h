#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "grove/lab/claims/claim.h"
#include "grove/lab/machine.h"

namespace grove {

struct ReproduceSettings {
  bool quick = false;
  /// Ids of claims; empty: all.
  std::vector<std::string> only = {};
  /// What was asked for, for the reader.
  std::string command = {};
};

/// A claim with what its experiment found; one without a finding has `error`.
struct CheckedClaim {
  std::string id;
  std::string statement;
  std::string source;
  std::string method;
  std::optional<Finding> finding;
  std::string error;
  double seconds = 0.0;
};

struct Reproduction {
  Machine machine;
  bool quick = false;
  std::string command;       ///< that was given; for the reader
  std::string date;          ///< of the last experiment: ISO 8601, UTC
  double seconds = 0.0;      ///< of all experiments
  bool is_complete = false;  ///< whether every claim that was asked for has been checked
  std::vector<CheckedClaim> claims;
};

/// Told of each claim; either may be left out.
struct ReproduceObserver {
  /// Before claim `number` of `total`, from 1 on; not for one that is taken over.
  std::function<void(const Claim& claim, std::size_t number, std::size_t total)> starts = {};
  /// After each claim, also one that is taken over: the last of `so_far`.
  std::function<void(const Reproduction& so_far)> finished = {};
};

/// Runs the experiments, one claim after the other, in the caller's oneTBB arena. Claims that `earlier` has a finding of are taken from there when
/// it can_resume. When `stop` asks, returns what is finished. An experiment that fails becomes a claim with an error. Throws UsageError for
/// an id that no claim has.
[[nodiscard]] Reproduction reproduce(const ReproduceSettings& settings, const Reproduction& earlier, const ReproduceObserver& observer = {},
                                     const std::stop_token& stop = {});

/// Whether the claims of `earlier` can be taken over: it was made with the same effort on the same machine, by the same commit.
[[nodiscard]] bool can_resume(const Reproduction& earlier, const ReproduceSettings& settings);

}  // namespace grove
