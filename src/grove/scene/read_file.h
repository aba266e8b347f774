#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace grove {

/// The bytes of a regular file. Throws InputError naming the file when it is not there, is not a regular file or cannot be read.
[[nodiscard]] std::vector<std::byte> read_file(const std::filesystem::path& file);

}  // namespace grove
