#include "grove/render/adaptive/round_planner.h"

#include <algorithm>
#include <limits>

namespace grove {
namespace {

// Rounds take longer than foreseen now and then; cutting one loses all of it.
constexpr double kCaution = 1.05;

}  // namespace

bool RoundPlanner::plan_next() {
  if (is_out_of_time_) return false;
  const bool is_rate_known = seconds_per_sample_ > 0.0;
  rounds_->plan(limit_->is_on() && !is_rate_known ? 1 : std::numeric_limits<std::uint32_t>::max());
  if (rounds_->samples() == 0) return false;
  is_first_ = rounds_->has_empty_pixels();
  if (limit_->is_on() && !is_first_) {
    const double left = limit_->left();
    const double cost = kCaution * seconds_per_sample_;
    if (cost * static_cast<double>(rounds_->samples()) > left) {
      const double each = left / (cost * static_cast<double>(rounds_->pixels()));
      if (each >= 1.0) rounds_->plan(static_cast<std::uint32_t>(std::min(each, 1e6)));
      is_out_of_time_ = each < 1.0;
    }
    if (!(left > 0.0)) is_out_of_time_ = true;
  }
  round_start_ = limit_->elapsed();
  return !is_out_of_time_;
}

void RoundPlanner::note_round(std::uint64_t samples_taken) {
  seconds_per_sample_ = (limit_->elapsed() - round_start_) / static_cast<double>(samples_taken);
}

std::uint64_t RoundPlanner::foreseen(std::uint64_t done, std::uint64_t wanted) const {
  const double elapsed = limit_->elapsed();
  if (!limit_->is_on() || !(elapsed > 0.0)) return std::max(done, wanted);
  const double in_time = static_cast<double>(done) * std::max(1.0, limit_->seconds() / elapsed);
  return std::max(done, in_time < static_cast<double>(wanted) ? static_cast<std::uint64_t>(in_time) : wanted);
}

}  // namespace grove
