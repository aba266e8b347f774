#include "console.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

namespace grove::app {
namespace {

/// Back to the start of the line, and clear it to its end.
constexpr std::string_view kClearLine = "\r\x1b[K";

}  // namespace

Console::Console(bool quiet) : is_quiet_(quiet), has_terminal_(has_progress_terminal()) {}

void Console::say(std::string_view line) const {
  if (is_quiet_) return;
  clear_status();
  fmt::print("{}\n", line);
  // At once, so that lines keep their order with standard error.
  std::fflush(stdout);
}

void Console::warn(std::string_view line) const {
  if (is_quiet_) return;
  clear_status();
  fmt::print(stderr, "warning: {}\n", one_line(line));
}

void Console::status(std::string_view line) const {
  if (is_quiet_ || !has_terminal_) return;
  fmt::print(stderr, "{}{}...", kClearLine, line);
  std::fflush(stderr);
}

void Console::clear_status() const {
  if (is_quiet_ || !has_terminal_) return;
  fmt::print(stderr, "{}", kClearLine);
  std::fflush(stderr);
}

bool has_progress_terminal() {
  const char* const terminal = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) == 1 && terminal != nullptr && std::string_view(terminal) != "dumb";
}

std::string one_line(std::string_view text) {
  std::string line;
  bool at_break = false;
  for (const char c : text) {
    if (c == '\n' || c == '\r') {
      while (!line.empty() && line.back() == ' ') line.pop_back();
      at_break = true;
      continue;
    }
    if (at_break && c == ' ') continue;
    if (at_break && !line.empty()) line += ' ';
    at_break = false;
    line += c;
  }
  return line;
}

}  // namespace grove::app
