#include "progress_bar.h"

#include <fmt/format.h>

#include <cstdio>

#include "console.h"
#include "grove/lab/text_table.h"

namespace grove::app {
namespace {

constexpr double kTerminalInterval = 0.1;  // seconds: as often as an eye follows
constexpr double kLineInterval = 5.0;
constexpr std::size_t kBarWidth = 24;

std::string rate_text(double rate, const std::string& unit) {
  if (rate >= 1e6) return short_number(rate * 1e-6) + " M" + unit + "/s";
  if (rate >= 1e3) return short_number(rate * 1e-3) + " k" + unit + "/s";
  return short_number(rate) + " " + unit + "/s";
}

}  // namespace

ProgressBar::ProgressBar(std::string label, std::string unit, double units_per_step, bool quiet)
    : label_(std::move(label)),
      unit_(std::move(unit)),
      units_per_step_(units_per_step),
      is_quiet_(quiet),
      has_terminal_(has_progress_terminal()) {}

ProgressBar::~ProgressBar() {
  if (is_drawn_) fmt::print(stderr, "\r\x1b[K");
}

void ProgressBar::update(std::uint64_t done, std::uint64_t total) {
  const double elapsed = timer_.seconds();
  if (is_quiet_ || done == 0 || total == 0 || elapsed - last_shown_ < (has_terminal_ ? kTerminalInterval : kLineInterval)) return;
  last_shown_ = elapsed;
  const double fraction = static_cast<double>(done) / static_cast<double>(total);
  const std::string rate = rate_text(static_cast<double>(done) * units_per_step_ / elapsed, unit_);
  const std::string left = duration(elapsed * (1.0 - fraction) / fraction);
  if (has_terminal_) {
    const auto filled = static_cast<std::size_t>(fraction * static_cast<double>(kBarWidth));
    fmt::print(stderr, "\r\x1b[K{} [{}{}] {:3.0f} %  {}  {} left", label_, std::string(filled, '#'), std::string(kBarWidth - filled, '.'),
               100.0 * fraction, rate, left);
    std::fflush(stderr);
    is_drawn_ = true;
  } else {
    fmt::print(stderr, "{}: {:.0f} %, {}, {} left\n", label_, 100.0 * fraction, rate, left);
  }
}

ProgressReporter ProgressBar::reporter(std::stop_token stop) {
  return {[this](std::uint64_t done, std::uint64_t total) { update(done, total); }, std::move(stop)};
}

}  // namespace grove::app
