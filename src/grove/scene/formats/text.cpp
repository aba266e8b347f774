#include "grove/scene/formats/text.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

namespace grove {

std::string quote(std::string_view word) {
  std::string text = "'";
  for (const char c : word.substr(0, 40)) text += c >= ' ' && c <= '~' ? c : '?';
  if (word.size() > 40) text += "...";
  return text + "'";
}

std::optional<float> parse_float(std::string_view word) {
  if (word.starts_with('+')) {
    word.remove_prefix(1);
    if (word.starts_with('-')) return std::nullopt;
  }
  const char* const last = word.data() + word.size();
  // By way of double, because many digits of a float are then rounded twice but never misread as out of range.
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), last, value);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (error == std::errc::result_out_of_range && end == last) {
    const bool tiny = word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos;
    value = tiny ? 0.0 : infinity;
    if (word.starts_with('-')) value = -value;
  } else if (error != std::errc()) {
    return std::nullopt;
  } else if (end != last) {
    const std::string_view rest(end, static_cast<std::size_t>(last - end));
    if (!rest.starts_with('#')) return std::nullopt;
    value = rest.starts_with("#INF") ? std::copysign(infinity, value) : std::numeric_limits<double>::quiet_NaN();
  }
  constexpr double limit = std::numeric_limits<float>::max();
  if (value > limit || value < -limit) value = std::copysign(infinity, value);
  return static_cast<float>(value);
}

}  // namespace grove
