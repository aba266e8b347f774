#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace grove {

/// Columns of text that line up: each as wide as its widest cell, two spaces apart.
class TextTable {
 public:
  enum class Align { left, right };
  struct Column {
    std::string heading;
    Align align = Align::left;
  };

  explicit TextTable(std::vector<Column> columns);

  /// As many cells as there are columns. UTF-8, one column of the terminal a character.
  void add_row(std::vector<std::string> cells);
  /// An empty line.
  void add_gap() { rows_.emplace_back(); }

  /// Heading, rule and rows, each ending with a newline and none with spaces.
  [[nodiscard]] std::string text() const;

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

/// The number with its thousands apart: 1,234,567.
[[nodiscard]] std::string with_separators(std::uint64_t number);

/// Three significant digits, in full: 0.0123, 4.56, 78.9, 1235.
[[nodiscard]] std::string short_number(double number);

/// Bytes in the unit that suits: 512 B, 1.50 KiB, 23.4 MiB.
[[nodiscard]] std::string byte_size(std::uint64_t bytes);

/// A time in the unit that suits: 12.3 ms, 4.56 s, 2 min 5 s.
[[nodiscard]] std::string duration(double seconds);

}  // namespace grove
