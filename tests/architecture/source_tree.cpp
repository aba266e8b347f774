#include "architecture/source_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>

namespace grove::architecture {

namespace fs = std::filesystem;

fs::path repository() {
  return fs::path(GROVE_SOURCE_DIR);
}

std::vector<fs::path> files_below(std::string_view folder, const std::vector<std::string>& extensions) {
  std::vector<fs::path> files;
  const fs::path top = repository() / folder;
  if (!fs::is_directory(top)) return files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(top)) {
    const std::string extension = entry.path().extension().string();
    if (entry.is_regular_file() && std::find(extensions.begin(), extensions.end(), extension) != extensions.end()) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string read(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  EXPECT_TRUE(stream) << file << " cannot be read";
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::vector<Line> lines_of(const std::string& text) {
  std::vector<Line> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back({lines.size() + 1, line});
  return lines;
}

std::string without_comments_and_strings(const std::string& text) {
  std::string result = text;
  const auto blank = [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last && i < result.size(); ++i) {
      if (result[i] != '\n') result[i] = ' ';
    }
  };
  std::size_t i = 0;
  const auto end_of = [&](std::string_view terminator, std::size_t from) {
    const std::size_t found = text.find(terminator, from);
    return found == std::string::npos ? text.size() : found + terminator.size();
  };
  while (i < text.size()) {
    const std::string_view rest = std::string_view(text).substr(i);
    const bool after_word = i > 0 && (std::isalnum(static_cast<unsigned char>(text[i - 1])) != 0 || text[i - 1] == '_');
    if (rest.starts_with("//")) {
      const std::size_t end = std::min(text.find('\n', i), text.size());
      blank(i, end);
      i = end;
    } else if (rest.starts_with("/*")) {
      const std::size_t end = end_of("*/", i + 2);
      blank(i, end);
      i = end;
    } else if (rest.starts_with("R\"") && !after_word) {
      const std::size_t open = text.find('(', i);
      const std::string terminator = ")" + text.substr(i + 2, open - i - 2) + "\"";
      const std::size_t end = end_of(terminator, open);
      blank(i + 2, end - 1);
      i = end;
    } else if (rest.front() == '"' || (rest.front() == '\'' && !after_word)) {
      // A quote after a letter or digit separates digits, as in 1'000.
      const char quote = rest.front();
      std::size_t end = i + 1;
      while (end < text.size() && text[end] != quote && text[end] != '\n') end += text[end] == '\\' ? 2 : 1;
      blank(i + 1, end);
      i = end + 1;
    } else {
      ++i;
    }
  }
  return result;
}

std::string room_of(const fs::path& file) {
  const fs::path relative = file.lexically_relative(repository());
  auto part = relative.begin();
  const auto next_is = [&](const char* name) { return part != relative.end() && *part++ == name; };
  if (next_is("src") && next_is("grove") && std::distance(part, relative.end()) >= 2) return part->string();
  return {};
}

std::vector<std::string> includes_of(const std::string& text) {
  static const std::regex include(R"(^\s*#\s*include\s+([<"][^>"]+[>"]))");
  std::vector<std::string> includes;
  for (const Line& line : lines_of(text)) {
    std::smatch match;
    if (std::regex_search(line.text, match, include)) includes.push_back(match[1]);
  }
  return includes;
}

std::string place(const fs::path& file, std::size_t line) {
  return file.lexically_relative(repository()).string() + ":" + std::to_string(line);
}

}  // namespace grove::architecture
