#include "cli/run_command.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>

#include "grove/base/timer.h"

namespace grove::testing {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kHasSanitizer = true;
#else
constexpr bool kHasSanitizer = false;
#endif

/// Polled this often: short against any run, long against the work of a poll.
constexpr std::chrono::milliseconds kPollInterval(5);
/// From seeing the awaited output to the signal: long enough that the work after it has begun.
constexpr std::chrono::milliseconds kSignalDelay(300);

/// In the child: never returns.
[[noreturn]] void become_command(const std::filesystem::path& directory, const std::filesystem::path& out, const std::filesystem::path& err,
                                 const std::vector<char*>& arguments, const CommandSettings& settings) {
  const int out_file = ::open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  const int err_file = ::open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  ::dup2(out_file, STDOUT_FILENO);
  ::dup2(err_file, STDERR_FILENO);
  if (settings.memory_limit && !kHasSanitizer) {
    const rlimit limit{*settings.memory_limit, *settings.memory_limit};
    ::setrlimit(RLIMIT_AS, &limit);
  }
  if (settings.file_limit) {
    const rlimit limit{*settings.file_limit, *settings.file_limit};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  if (::chdir(directory.c_str()) == 0) ::execv(GROVE_COMMAND, arguments.data());
  ::_exit(127);
}

bool is_time_for_signal(const TemporaryDirectory& directory, const std::filesystem::path& out, const CommandSettings& settings) {
  if (!settings.signal_when_file.empty()) return std::filesystem::exists(directory / settings.signal_when_file);
  return read_file(out).find(settings.signal_when) != std::string::npos;
}

}  // namespace

CommandResult run_command(const TemporaryDirectory& directory, const std::vector<std::string>& arguments, const CommandSettings& settings) {
  const TemporaryDirectory output;
  const auto out = output / "out";
  const auto err = output / "err";
  std::vector<std::string> words{"grove"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);

  const pid_t child = ::fork();
  if (child == 0) become_command(directory.path(), out, err, pointers, settings);
  EXPECT_GT(child, 0) << "cannot start a process";

  const Timer timer;
  CommandResult result;
  bool is_signalled = false;
  int status = 0;
  while (::waitpid(child, &status, WNOHANG) == 0) {
    if (timer.seconds() > settings.time_limit) {
      ::kill(child, SIGKILL);
      ::waitpid(child, &status, 0);
      ADD_FAILURE() << "took longer than " << settings.time_limit << " s";
      return result;
    }
    if (settings.signal && !is_signalled && is_time_for_signal(directory, out, settings)) {
      std::this_thread::sleep_for(kSignalDelay);
      ::kill(child, *settings.signal);
      is_signalled = true;
    }
    std::this_thread::sleep_for(kPollInterval);
  }
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  result.out = read_file(out);
  result.err = read_file(err);
  return result;
}

std::size_t line_count(const std::string& text) {
  const auto newlines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  return newlines + (text.empty() || text.back() == '\n' ? 0 : 1);
}

void expect_failure(const CommandResult& result, int exit_code) {
  EXPECT_EQ(result.exit_code, exit_code);
  EXPECT_EQ(line_count(result.err), 1U) << result.err;
  EXPECT_TRUE(result.err.starts_with("grove")) << result.err;
}

}  // namespace grove::testing
