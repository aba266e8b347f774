#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace grove::pbrt {

/// A whole word as a number: decimal or scientific, an optional sign in front, nan and inf too. What is too large for a float becomes an
/// infinity, what is too small 0. Nothing when the word is not a number.
[[nodiscard]] std::optional<float> parse_float(std::string_view word);

/// A whole word as a 32-bit integer; a number with a fraction of 0 such as 4.0 or 1e3 counts. Nothing when it is not one or does not fit.
[[nodiscard]] std::optional<std::int32_t> parse_integer(std::string_view word);

}  // namespace grove::pbrt
