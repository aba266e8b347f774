#pragma once

#include <functional>
#include <limits>
#include <utility>

#include "grove/base/timer.h"

namespace grove {

/// Seconds that work may take from when this is made.
class TimeLimit {
 public:
  /// 0 seconds: no limit. `clock` gives seconds from any beginning on and may be called by any thread; empty takes the machine's.
  TimeLimit(double seconds, std::function<double()> clock) : seconds_(seconds), clock_(std::move(clock)), start_(now()) {}

  [[nodiscard]] bool is_on() const { return seconds_ > 0.0; }
  [[nodiscard]] double seconds() const { return seconds_; }
  [[nodiscard]] double elapsed() const { return now() - start_; }
  [[nodiscard]] double left() const { return is_on() ? seconds_ - elapsed() : std::numeric_limits<double>::infinity(); }
  [[nodiscard]] bool is_over() const { return is_on() && elapsed() > seconds_; }

 private:
  [[nodiscard]] double now() const { return clock_ ? clock_() : timer_.seconds(); }

  double seconds_;
  std::function<double()> clock_;
  Timer timer_;
  double start_;
};

}  // namespace grove
