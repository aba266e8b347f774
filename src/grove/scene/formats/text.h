#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace grove {

/// `word` in quotation marks for a message: cut to 40 characters, with '?' for what is not printable ASCII.
[[nodiscard]] std::string quote(std::string_view word);

/// A decimal number, whatever the program's locale; also "nan" and "inf" in any case, and what the C library of Windows once printed for
/// them (1.#IND, 1.#QNAN, 1.#INF). Beyond the range of float it is infinite or zero. Nothing when the whole word is not a number.
[[nodiscard]] std::optional<float> parse_float(std::string_view word);

}  // namespace grove
