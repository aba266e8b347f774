#include "interrupts.h"

#include <pthread.h>
#include <unistd.h>

#include <string_view>

#include "verbs.h"

namespace grove::app {

Interrupts::Interrupts() {
  sigemptyset(&signals_);
  sigaddset(&signals_, SIGINT);
  sigaddset(&signals_, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
  // A file that may not grow larger is an error of the write, as a full disk is.
  std::signal(SIGXFSZ, SIG_IGN);
  watcher_ = std::thread([this] { watch(); });
}

Interrupts::~Interrupts() {
  is_ending_ = true;
  // Wakes the watcher, which then sees that it is to end.
  pthread_kill(watcher_.native_handle(), SIGTERM);  // NOLINT(bugprone-bad-signal-to-kill-thread): blocked, and waited for
  watcher_.join();
}

void Interrupts::watch() {
  while (true) {
    int signal = 0;
    if (sigwait(&signals_, &signal) != 0) continue;
    if (is_ending_) return;
    if (graceful_scopes_ > 0 && !stop_.stop_requested()) {
      stop_.request_stop();
      continue;
    }
    constexpr std::string_view kMessage = "grove: interrupted\n";
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, kMessage.data(), kMessage.size());
    ::_exit(kInterrupted);
  }
}

}  // namespace grove::app
