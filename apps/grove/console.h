#pragma once

#include <string>
#include <string_view>

namespace grove::app {

/// What the command says besides its results: remarks on standard output; warnings, and what it is busy with, on standard error.
/// A quiet console says nothing.
class Console {
 public:
  explicit Console(bool quiet);

  [[nodiscard]] bool is_quiet() const { return is_quiet_; }

  /// A line about what was done.
  void say(std::string_view line) const;
  /// "warning: line" on standard error.
  void warn(std::string_view line) const;
  /// On a terminal, shows what is being done until something else is said or `clear_status` is called. Otherwise nothing.
  void status(std::string_view line) const;
  void clear_status() const;

 private:
  bool is_quiet_;
  bool has_terminal_;
};

/// Whether standard error is a terminal that can go back to the start of a line.
[[nodiscard]] bool has_progress_terminal();

/// The text on one line: line ends and what surrounds them become one space.
[[nodiscard]] std::string one_line(std::string_view text);

}  // namespace grove::app
