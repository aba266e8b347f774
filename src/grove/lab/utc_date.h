#pragma once

#include <chrono>
#include <ctime>
#include <string>

namespace grove {

/// Now, in UTC, as ISO 8601 writes it: 2026-01-31T12:34:56Z.
[[nodiscard]] inline std::string utc_date() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts)};
}

}  // namespace grove
