#pragma once

#include <cstdint>
#include <string>

#include "grove/base/progress.h"
#include "grove/base/timer.h"

namespace grove::app {

/// Shows on standard error how far long work has come, its rate, and the time left: a bar that stays on its line on a terminal, otherwise
/// a line every few seconds. Quick work is never mentioned. Not for several threads at once.
class ProgressBar {
 public:
  /// `unit` names what the rate counts, such as "samples"; one unit of progress is `units_per_step` of them.
  ProgressBar(std::string label, std::string unit, double units_per_step, bool quiet);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void update(std::uint64_t done, std::uint64_t total);

  /// A reporter that updates this bar, which must outlive it.
  [[nodiscard]] ProgressReporter reporter(std::stop_token stop);

 private:
  std::string label_;
  std::string unit_;
  double units_per_step_;
  bool is_quiet_;
  bool has_terminal_;
  bool is_drawn_ = false;
  Timer timer_;
  double last_shown_ = 0.0;
};

}  // namespace grove::app
