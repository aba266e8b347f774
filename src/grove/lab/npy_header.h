#pragma once

#include <cstdint>
#include <istream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace grove {

/// What stands before the data of a NumPy array file (.npy; NumPy Enhancement Proposal 1, format versions 1 to 3).
struct NpyHeader {
  /// The element type as NumPy writes it: '<f4', or the list of a structured type, without the outer quotes.
  std::string descr;
  bool fortran_order = false;
  std::vector<std::uint64_t> shape;
  std::uint64_t data_offset = 0;  ///< bytes from the start of the file
};

/// Reads a header from the start of `stream`. `file` is named in errors, `file_size` bounds what is read.
/// Throws InputError when it is not a NumPy array file, or its header is broken or does not fit in the file.
[[nodiscard]] NpyHeader read_npy_header(std::istream& stream, std::string_view file, std::uint64_t file_size);

/// A version 1 header for a C-ordered array; the data that follows is aligned to 64 bytes. `descr` is a Python literal.
[[nodiscard]] std::string format_npy_header(std::string_view descr, std::span<const std::uint64_t> shape);

}  // namespace grove
