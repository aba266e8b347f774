#include "command_line.h"

#include <string_view>

namespace grove::app {
namespace {

std::string& kept() {
  static std::string line;
  return line;
}

bool is_plain(char c) {
  const std::string_view others = "_-+./:,=%@";
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || others.find(c) != std::string_view::npos;
}

std::string quoted(std::string_view word) {
  bool plain = !word.empty();
  for (const char c : word) plain = plain && is_plain(c);
  if (plain) return std::string(word);
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

}  // namespace

void keep_command_line(int argument_count, const char* const* arguments) {
  std::string line = "grove";
  for (int i = 1; i < argument_count; ++i) line += ' ' + quoted(arguments[i]);
  kept() = line;
}

const std::string& command_line() {
  return kept();
}

}  // namespace grove::app
