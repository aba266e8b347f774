#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>

namespace grove::app {

struct BuildLimits {
  double seconds = 0.0;     ///< 0: no limit
  std::uint64_t bytes = 0;  ///< 0: no limit

  [[nodiscard]] bool any() const { return seconds > 0.0 || bytes > 0; }
};

/// Builds structures in a process of its own, which can be ended whatever it is doing and takes nothing down with it. The process loads the scene
/// once; after one that had to be ended, another is started. Not for several threads at once.
class TrialBuilder {
 public:
  TrialBuilder(std::string scene, std::optional<unsigned> threads, BuildLimits limits, std::stop_token stop);
  ~TrialBuilder();
  TrialBuilder(const TrialBuilder&) = delete;
  TrialBuilder& operator=(const TrialBuilder&) = delete;

  /// Builds a structure: empty when that went well within the limits, else what went wrong. The memory of a build is by how much what the process has in
  /// memory grows, at its most. Throws Stopped (grove/lab/structure_trial.h) where `stop` asks, and Error when the process cannot be started or cannot load the scene.
  [[nodiscard]] std::string try_build(const std::string& spec);

 private:
  void start();
  void end();
  /// The next line that the process writes; nothing when it has ended. `check` is called every few milliseconds, and throws to stop waiting.
  [[nodiscard]] std::optional<std::string> next_line(const auto& check);
  void check_stop();
  [[nodiscard]] std::string cause_of_end();

  std::string scene_;
  std::optional<unsigned> threads_;
  BuildLimits limits_;
  std::stop_token stop_;
  pid_t process_ = -1;
  int to_process_ = -1;
  int from_process_ = -1;
  std::string received_;
};

}  // namespace grove::app
