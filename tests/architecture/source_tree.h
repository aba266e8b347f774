#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace grove::architecture {

/// One line of a source, with the text of comments and string literals blanked where asked for.
struct Line {
  std::size_t number = 0;  ///< from 1
  std::string text;
};

/// The root of the repository.
[[nodiscard]] std::filesystem::path repository();

/// Files below `folder` (relative to the repository) with one of the extensions, sorted; empty when the folder is not there.
[[nodiscard]] std::vector<std::filesystem::path> files_below(std::string_view folder, const std::vector<std::string>& extensions);

/// The whole file. Fails the running test when it cannot be read.
[[nodiscard]] std::string read(const std::filesystem::path& file);

[[nodiscard]] std::vector<Line> lines_of(const std::string& text);

/// C++ text with comments and the insides of string and character literals replaced by blanks; lines stay where they are.
[[nodiscard]] std::string without_comments_and_strings(const std::string& text);

/// The room of a file under src/grove or tests: the name of its first folder there; empty for others.
[[nodiscard]] std::string room_of(const std::filesystem::path& file);

/// What follows #include on each line that has one, quotes or brackets and all.
[[nodiscard]] std::vector<std::string> includes_of(const std::string& text);

/// "path:line", relative to the repository: for messages.
[[nodiscard]] std::string place(const std::filesystem::path& file, std::size_t line);

}  // namespace grove::architecture
