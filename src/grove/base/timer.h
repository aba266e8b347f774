#pragma once

#include <chrono>

namespace grove {

/// Wall-clock stopwatch; starts when made.
class Timer {
 public:
  Timer() : start_(std::chrono::steady_clock::now()) {}

  /// Seconds since construction.
  [[nodiscard]] double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_;
};

}  // namespace grove
