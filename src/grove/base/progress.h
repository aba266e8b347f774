#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>

namespace grove {

/// What long work needs from its caller: a place to report to, and a way to be stopped. The library itself never prints.
struct ProgressReporter {
  /// Called with units done and units in all, from any thread but never from two at once; may be empty.
  std::function<void(std::uint64_t done, std::uint64_t total)> report;
  /// Work that honours it stops at the next unit and returns what is finished.
  std::stop_token stop;
};

}  // namespace grove
