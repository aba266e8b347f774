#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lab/temporary_directory.h"

namespace grove::testing {

/// What came of a run of the grove command.
struct CommandResult {
  int exit_code = -1;  ///< 128 plus the signal when one ended it; -1 when it had to be stopped for taking too long
  std::string out;
  std::string err;
};

struct CommandSettings {
  /// Seconds after which the command is stopped.
  double time_limit = 60.0;
  /// Bytes of address space; not kept to in builds with a sanitizer, which reserve terabytes.
  std::optional<std::uint64_t> memory_limit;
  /// Bytes that a file may grow to, as on a disk that fills up.
  std::optional<std::uint64_t> file_limit;
  /// Signal sent when `signal_when` is to be found in what the command has written to standard output, and a moment has passed.
  std::optional<int> signal;
  std::string signal_when;
  /// The same when this file has appeared in `directory`; then nothing is waited for on standard output.
  std::string signal_when_file;
};

/// Runs the grove command with these arguments in `directory`, where relative paths lie.
CommandResult run_command(const TemporaryDirectory& directory, const std::vector<std::string>& arguments,
                          const CommandSettings& settings = {});

/// How many lines `text` has; text after the last newline counts as one.
std::size_t line_count(const std::string& text);

/// Expects the exit code, and exactly one line on standard error.
void expect_failure(const CommandResult& result, int exit_code);

}  // namespace grove::testing
