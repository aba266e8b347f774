#include "frame_names.h"

#include <fmt/format.h>

#include "grove/base/error.h"

namespace grove::app {
namespace {

/// A name, taken apart at its number.
struct NamePattern {
  std::string before;
  std::string after;
  bool has_number = false;
  int digits = 0;
};

[[noreturn]] void fail(const std::string& name, std::string_view option) {
  throw UsageError(fmt::format("{}: '{}' may have one %d or %04d, for the number of the frame; write %% for a percent sign", option, name));
}

NamePattern take_apart(const std::string& name, std::string_view option) {
  NamePattern pattern;
  std::size_t i = 0;
  while (i < name.size()) {
    std::string& part = pattern.has_number ? pattern.after : pattern.before;
    if (name[i] != '%') {
      part += name[i++];
      continue;
    }
    if (name.compare(i, 2, "%%") == 0) {
      part += '%';
      i += 2;
      continue;
    }
    std::size_t end = i + 1;
    int digits = 0;
    constexpr int kMostDigits = 9;
    if (end < name.size() && name[end] == '0') {
      for (++end; end < name.size() && name[end] >= '0' && name[end] <= '9' && digits <= kMostDigits; ++end)
        digits = 10 * digits + (name[end] - '0');
      if (digits == 0) fail(name, option);
    }
    if (end >= name.size() || name[end] != 'd' || pattern.has_number || digits > kMostDigits) fail(name, option);
    pattern.has_number = true;
    pattern.digits = digits;
    i = end + 1;
  }
  return pattern;
}

}  // namespace

bool has_frame_number(const std::string& name, std::string_view option) {
  return take_apart(name, option).has_number;
}

std::string frame_name(const std::string& name, std::uint32_t number, std::string_view option) {
  const NamePattern pattern = take_apart(name, option);
  return pattern.has_number ? fmt::format("{}{:0{}}{}", pattern.before, number, pattern.digits, pattern.after) : pattern.before;
}

}  // namespace grove::app
