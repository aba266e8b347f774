#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "grove/scene/formats/byte_stream.h"

namespace grove {

enum class PlyEncoding : std::uint8_t { ascii, little_endian, big_endian };

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

[[nodiscard]] constexpr std::size_t ply_type_size(PlyType type) {
  constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

[[nodiscard]] constexpr bool is_ply_float(PlyType type) {
  return type >= PlyType::float32;
}

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  bool is_list = false;
  PlyType count_type = PlyType::uint8;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  [[nodiscard]] bool has_list() const;
  /// Bytes of one row where no property is a list.
  [[nodiscard]] std::size_t row_size() const;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
};

/// Reads the header (Turk 1994, "The PLY Polygon File Format") and leaves `stream` at the first byte of the body. Throws InputError for a
/// header that is wrong, or that promises more than the rest of the file can hold.
[[nodiscard]] PlyHeader read_ply_header(ByteStream& stream);

}  // namespace grove
