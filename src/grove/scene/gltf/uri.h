#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace grove {

/// The bytes of a base64 data URI ("data:...;base64,..."); nothing when `uri` is not a data URI.
/// Throws InputError naming `file` and `place` when it is one but broken.
[[nodiscard]] std::optional<std::vector<std::byte>> decode_data_uri(std::string_view uri, const std::string& file,
                                                                    const std::string& place);

/// The file that a relative URI names beside `file`, percent-escapes decoded. Throws InputError naming `file` and `place` when the URI
/// is absolute, has a scheme, or has a broken escape or a zero byte.
[[nodiscard]] std::filesystem::path resolve_uri(std::string_view uri, const std::string& file, const std::string& place);

}  // namespace grove
