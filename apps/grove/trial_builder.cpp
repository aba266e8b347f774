#include "trial_builder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <array>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

#include "grove/base/error.h"
#include "grove/base/timer.h"
#include "grove/lab/structure_trial.h"
#include "grove/lab/text_table.h"

namespace grove::app {
namespace {

/// How often limits are looked at: a build takes in some tens of megabytes in this time.
constexpr int kPollMilliseconds = 5;

/// A limit was exceeded; `what` says which.
struct OverLimit {
  std::string what;
};

/// A figure of /proc/PID/status in bytes; 0 where there is none.
std::uint64_t memory_figure(pid_t process, std::string_view name) {
  std::ifstream file(fmt::format("/proc/{}/status", process));
  std::string line;
  while (std::getline(file, line)) {
    if (!line.starts_with(name)) continue;
    constexpr std::uint64_t kUnit = 1024;
    return kUnit * std::strtoull(line.c_str() + name.size(), nullptr, 10);
  }
  return 0;
}

std::uint64_t memory_now(pid_t process) {
  return memory_figure(process, "VmRSS:");
}
std::uint64_t memory_peak(pid_t process) {
  return memory_figure(process, "VmHWM:");
}

/// From here on the peak is that of what comes. Where the system does not allow it, the peak may be an earlier one, if that was higher.
void reset_memory_peak(pid_t process) {
  std::ofstream(fmt::format("/proc/{}/clear_refs", process)) << '5';
}

/// In the new process: only calls that are safe between fork and exec. Never returns.
[[noreturn]] void become_worker(int input, int output, const char* program, char* const* arguments) {
  // A Ctrl-C is for the parent, which then ends this process.
  ::setpgid(0, 0);
#ifdef __linux__
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  ::dup2(input, STDIN_FILENO);
  ::dup2(output, STDOUT_FILENO);
  ::execv(program, arguments);
  ::_exit(127);
}

}  // namespace

TrialBuilder::TrialBuilder(std::string scene, std::optional<unsigned> threads, BuildLimits limits, std::stop_token stop)
    : scene_(std::move(scene)), threads_(threads), limits_(limits), stop_(std::move(stop)) {}

TrialBuilder::~TrialBuilder() {
  end();
}

void TrialBuilder::start() {
  std::error_code error;
  const std::string program = std::filesystem::read_symlink("/proc/self/exe", error).string();
  if (error) throw Error("limits need /proc, which is not there; leave out --time-limit and --memory-limit");
  std::vector<std::string> words{program, "try-build", scene_};
  if (threads_) words.insert(words.end(), {"--threads", std::to_string(*threads_)});
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  std::array<int, 2> input{-1, -1};
  std::array<int, 2> output{-1, -1};
  if (::pipe2(input.data(), O_CLOEXEC) != 0 || ::pipe2(output.data(), O_CLOEXEC) != 0)
    throw Error("no pipe can be made to a process that tries builds: too many files are open");
  process_ = ::fork();
  if (process_ == 0) become_worker(input[0], output[1], program.c_str(), arguments.data());
  ::close(input[0]);
  ::close(output[1]);
  to_process_ = input[1];
  from_process_ = output[0];
  received_.clear();
  if (process_ < 0) throw Error("no process can be started to try builds in: too many are running");
  const auto line = next_line([this] { check_stop(); });
  if (line != "ready") throw Error(scene_ + ": cannot be loaded a second time to try builds (" + cause_of_end() + ")");
}

void TrialBuilder::end() {
  if (process_ > 0) {
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }
  process_ = -1;
  for (int* const descriptor : {&to_process_, &from_process_}) {
    if (*descriptor >= 0) ::close(*descriptor);
    *descriptor = -1;
  }
}

void TrialBuilder::check_stop() {
  if (stop_.stop_requested()) throw Stopped();
}

std::optional<std::string> TrialBuilder::next_line(const auto& check) {
  while (true) {
    const std::size_t end = received_.find('\n');
    if (end != std::string::npos) {
      std::string line = received_.substr(0, end);
      received_.erase(0, end + 1);
      return line;
    }
    pollfd waiting{from_process_, POLLIN, 0};
    if (::poll(&waiting, 1, kPollMilliseconds) > 0) {
      std::array<char, 512> bytes{};
      const ssize_t count = ::read(from_process_, bytes.data(), bytes.size());
      if (count <= 0) return std::nullopt;
      received_.append(bytes.data(), static_cast<std::size_t>(count));
    }
    check();
  }
}

std::string TrialBuilder::cause_of_end() {
  int status = 0;
  ::waitpid(process_, &status, 0);
  process_ = -1;
  if (!WIFSIGNALED(status)) return fmt::format("the process ended with code {}", WEXITSTATUS(status));
  if (WTERMSIG(status) == SIGKILL) return "the system ended the process, which it does when memory runs out";
  return fmt::format("the process was ended by signal {}", WTERMSIG(status));
}

std::string TrialBuilder::try_build(const std::string& spec) {
  check_stop();
  if (process_ < 0) {
    end();
    start();
  }
  const std::uint64_t before = memory_now(process_);
  reset_memory_peak(process_);
  const auto check_memory = [&] {
    if (limits_.bytes > 0 && std::max(memory_now(process_), memory_peak(process_)) > before + limits_.bytes)
      throw OverLimit{fmt::format("building takes more memory than the limit of {}", byte_size(limits_.bytes))};
  };
  const Timer timer;
  const auto check = [&] {
    check_stop();
    check_memory();
    if (limits_.seconds > 0.0 && timer.seconds() > limits_.seconds)
      throw OverLimit{fmt::format("building takes longer than the time limit of {} s", limits_.seconds)};
  };
  const std::string request = spec + '\n';
  if (::write(to_process_, request.data(), request.size()) != static_cast<ssize_t>(request.size())) return cause_of_end();
  try {
    std::optional<std::string> answer = next_line(check);
    if (!answer) return cause_of_end();
    check_memory();
    // It gives the memory back, and says when.
    if (next_line([this] { check_stop(); }) != "ready") return cause_of_end();
    constexpr std::string_view kFailed = "failed ";
    return answer->starts_with(kFailed) ? answer->substr(kFailed.size()) : std::string();
  } catch (const OverLimit& over) {
    end();
    return over.what;
  }
}

}  // namespace grove::app
