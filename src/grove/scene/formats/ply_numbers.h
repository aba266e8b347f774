#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "grove/scene/formats/byte_stream.h"
#include "grove/scene/formats/ply_header.h"

namespace grove {

/// One number of a binary row; doubles beyond the range of float become infinite. `swap`: the file has the other byte order.
[[nodiscard]] float load_ply_float(const std::byte* data, PlyType type, bool swap);

/// Numbers of a PLY body, one after the other, from text or binary. Every failure is an InputError at the line or byte.
class PlyNumbers {
 public:
  PlyNumbers(ByteStream& stream, PlyEncoding encoding);

  [[nodiscard]] bool is_text() const { return text_; }
  /// Whether the file has the other byte order than this machine.
  [[nodiscard]] bool swaps() const { return swap_; }

  float next_float(PlyType type);
  std::int64_t next_integer(PlyType type);
  /// The length of a list, checked against the rest of the file.
  std::uint64_t next_list_length(const PlyProperty& property);
  void skip(const PlyProperty& property);

  [[noreturn]] void fail(std::string_view problem) const;

 private:
  ByteStream& stream_;
  bool text_;
  bool swap_;
};

}  // namespace grove
