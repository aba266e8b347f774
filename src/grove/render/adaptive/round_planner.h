#pragma once

#include <cstdint>

#include "grove/render/adaptive/sample_rounds.h"
#include "grove/render/time_limit.h"

namespace grove {

/// Makes rounds of samples fit into a time limit, by what a sample took in the round before.
class RoundPlanner {
 public:
  /// Both must outlive it.
  RoundPlanner(SampleRounds& rounds, const TimeLimit& limit) : rounds_(&rounds), limit_(&limit) {}

  /// Plans the next round. False when there is none, or no time for one sample of each pixel that is in it.
  [[nodiscard]] bool plan_next();
  /// After a round that was finished.
  void note_round(std::uint64_t samples_taken);
  /// No further rounds.
  void stop_in_time() { is_out_of_time_ = true; }

  /// There would have been samples left to take.
  [[nodiscard]] bool is_out_of_time() const { return is_out_of_time_; }
  /// Some pixel has no sample yet: the round makes the picture whole, and is not to be cut.
  [[nodiscard]] bool is_first_round() const { return is_first_; }
  /// How many samples there will be in all, of which there are `done`, when `wanted` are taken as far as time allows.
  [[nodiscard]] std::uint64_t foreseen(std::uint64_t done, std::uint64_t wanted) const;

 private:
  SampleRounds* rounds_;
  const TimeLimit* limit_;
  double seconds_per_sample_ = 0.0;  // 0: not known
  double round_start_ = 0.0;
  bool is_first_ = false;
  bool is_out_of_time_ = false;
};

}  // namespace grove
