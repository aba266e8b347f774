#pragma once

#include <csignal>

#include <atomic>
#include <stop_token>
#include <thread>

namespace grove::app {

/// Turns Ctrl-C (SIGINT) and SIGTERM into a stop request. As long as nothing would be lost, a signal ends the process at once with exit
/// code 130; while a Graceful scope lives, the first signal only requests a stop, and the second ends the process.
///
/// Signals are waited for by a thread of their own, so that nothing has to be safe inside a signal handler. Make one before any other
/// thread is started: threads inherit that the signals are blocked.
class Interrupts {
 public:
  Interrupts();
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;

  [[nodiscard]] std::stop_token token() const { return stop_.get_token(); }
  [[nodiscard]] bool requested() const { return stop_.stop_requested(); }

  /// Work that has something to save.
  class Graceful {
   public:
    explicit Graceful(Interrupts& interrupts) : interrupts_(interrupts) { ++interrupts_.graceful_scopes_; }
    ~Graceful() { --interrupts_.graceful_scopes_; }
    Graceful(const Graceful&) = delete;
    Graceful& operator=(const Graceful&) = delete;

   private:
    Interrupts& interrupts_;
  };

 private:
  void watch();

  sigset_t signals_{};
  std::stop_source stop_;
  std::atomic<int> graceful_scopes_ = 0;
  std::atomic<bool> is_ending_ = false;
  std::thread watcher_;
};

}  // namespace grove::app
