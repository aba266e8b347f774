#pragma once

#include <CLI/App.hpp>
#include <functional>

#include "interrupts.h"

namespace grove::app {

/// Exit codes other than 0, success.
inline constexpr int kWorkFailed = 1;
inline constexpr int kWrongCommand = 2;
inline constexpr int kInterrupted = 130;

/// One verb of the command: its options, and what runs once they are parsed and returns the exit code. `run` throws grove::UsageError for
/// what only turns out to be a wrong command later, and other exceptions when the work fails.
struct Verb {
  CLI::App* options = nullptr;
  std::function<int(Interrupts&)> run;
};

// Each adds its verb to the program; one source file a verb.
[[nodiscard]] Verb add_render(CLI::App& program);
[[nodiscard]] Verb add_merge(CLI::App& program);
[[nodiscard]] Verb add_trace(CLI::App& program);
[[nodiscard]] Verb add_compare(CLI::App& program);
[[nodiscard]] Verb add_animate(CLI::App& program);
[[nodiscard]] Verb add_inspect(CLI::App& program);
[[nodiscard]] Verb add_reproduce(CLI::App& program);
[[nodiscard]] Verb add_structures(CLI::App& program);
/// Not for people, and not listed: see TrialBuilder.
[[nodiscard]] Verb add_try_build(CLI::App& program);

}  // namespace grove::app
