#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace grove::app {

/// Whether a picture's name has a place for the number of its frame: %d, or %04d for four digits with zeros before. Throws UsageError when it has two, or
/// another % (which is written %%), that names the option.
[[nodiscard]] bool has_frame_number(const std::string& name, std::string_view option = "-o");

/// The name with the number in its place.
[[nodiscard]] std::string frame_name(const std::string& name, std::uint32_t number, std::string_view option = "-o");

}  // namespace grove::app
