#include "grove/scene/pbrt/numbers.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

namespace grove::pbrt {
namespace {

// from_chars takes a minus but not a plus.
std::string_view without_plus(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+') word.remove_prefix(1);
  return word;
}

// from_chars says only "out of range": tell too large from too small by the sign of the exponent.
double out_of_range_value(std::string_view word) {
  const std::size_t exponent = word.find_first_of("eE");
  const bool small = exponent != std::string_view::npos ? word.substr(exponent + 1).starts_with('-') : word.find("0.") <= 1;
  const double magnitude = small ? 0.0 : std::numeric_limits<double>::infinity();
  return word.starts_with('-') ? -magnitude : magnitude;
}

std::optional<double> parse_double(std::string_view word) {
  word = without_plus(word);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size()) return std::nullopt;
  if (error == std::errc::result_out_of_range) return out_of_range_value(word);
  if (error != std::errc()) return std::nullopt;
  return value;
}

}  // namespace

std::optional<float> parse_float(std::string_view word) {
  const std::optional<double> value = parse_double(word);
  if (!value) return std::nullopt;
  // A double beyond the range of float must not reach the cast, which would be undefined.
  if (std::abs(*value) > std::numeric_limits<float>::max()) {
    return std::copysign(std::numeric_limits<float>::infinity(), static_cast<float>(std::copysign(1.0, *value)));
  }
  return static_cast<float>(*value);
}

std::optional<std::int32_t> parse_integer(std::string_view word) {
  word = without_plus(word);
  std::int32_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc() && end == word.data() + word.size()) return value;
  const std::optional<double> real = parse_double(word);
  if (!real || std::floor(*real) != *real || std::abs(*real) > std::numeric_limits<std::int32_t>::max()) return std::nullopt;
  return static_cast<std::int32_t>(*real);
}

}  // namespace grove::pbrt
