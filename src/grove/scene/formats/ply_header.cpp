#include "grove/scene/formats/ply_header.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string_view>

#include "grove/scene/formats/text.h"

namespace grove {
namespace {

// Far above any real file, and low enough that a row fits into one piece of a stream.
constexpr std::size_t kMaxElements = 256;
constexpr std::size_t kMaxProperties = 1024;
// Vertices and triangles are numbered with 32 bits, and the highest number means "none".
constexpr std::uint64_t kMaxCount = 0xfffffffeULL;

std::string_view next_word(std::string_view& line) {
  const std::size_t first = std::min(line.find_first_not_of(" \t"), line.size());
  line.remove_prefix(first);
  const std::string_view word = line.substr(0, line.find_first_of(" \t"));
  line.remove_prefix(word.size());
  return word;
}

std::optional<PlyType> parse_type(std::string_view word) {
  struct Name {
    std::string_view word;
    PlyType type;
  };
  static constexpr std::array<Name, 16> names{{{"char", PlyType::int8},
                                               {"int8", PlyType::int8},
                                               {"uchar", PlyType::uint8},
                                               {"uint8", PlyType::uint8},
                                               {"short", PlyType::int16},
                                               {"int16", PlyType::int16},
                                               {"ushort", PlyType::uint16},
                                               {"uint16", PlyType::uint16},
                                               {"int", PlyType::int32},
                                               {"int32", PlyType::int32},
                                               {"uint", PlyType::uint32},
                                               {"uint32", PlyType::uint32},
                                               {"float", PlyType::float32},
                                               {"float32", PlyType::float32},
                                               {"double", PlyType::float64},
                                               {"float64", PlyType::float64}}};
  for (const Name& name : names) {
    if (name.word == word) return name.type;
  }
  return std::nullopt;
}

PlyType require_type(const ByteStream& stream, std::string_view word) {
  const std::optional<PlyType> type = parse_type(word);
  if (!type) stream.fail_at_line("unknown property type " + quote(word));
  return *type;
}

PlyEncoding parse_encoding(const ByteStream& stream, std::string_view rest) {
  const std::string_view word = next_word(rest);
  if (word == "ascii") return PlyEncoding::ascii;
  if (word == "binary_little_endian") return PlyEncoding::little_endian;
  if (word == "binary_big_endian") return PlyEncoding::big_endian;
  stream.fail_at_line("unknown format " + quote(word) + "; allowed are ascii, binary_little_endian and binary_big_endian");
}

PlyElement parse_element(const ByteStream& stream, std::string_view rest) {
  PlyElement element;
  element.name = next_word(rest);
  const std::string_view count = next_word(rest);
  const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), element.count);
  if (error != std::errc() || end != count.data() + count.size() || element.count > kMaxCount) {
    stream.fail_at_line("element count " + quote(count) + " is not a number from 0 to 4294967294");
  }
  return element;
}

PlyProperty parse_property(const ByteStream& stream, std::string_view rest) {
  PlyProperty property;
  std::string_view word = next_word(rest);
  if (word == "list") {
    property.is_list = true;
    property.count_type = require_type(stream, next_word(rest));
    if (is_ply_float(property.count_type)) stream.fail_at_line("the length of a list must be an integer type");
    word = next_word(rest);
  }
  property.type = require_type(stream, word);
  property.name = next_word(rest);
  if (property.name.empty()) stream.fail_at_line("the property has no name");
  return property;
}

// The fewest bytes that one row can take: a list may be empty, and a number of a text takes a digit and white space.
std::uint64_t least_row_bytes(const PlyElement& element, PlyEncoding encoding) {
  std::uint64_t bytes = 0;
  for (const PlyProperty& property : element.properties) {
    if (encoding == PlyEncoding::ascii) {
      bytes += 2;
    } else {
      bytes += ply_type_size(property.is_list ? property.count_type : property.type);
    }
  }
  return bytes;
}

void check_sizes(const ByteStream& stream, const PlyHeader& header) {
  // One more, because the last number of a text may end with the file.
  std::uint64_t left = stream.remaining_at_most() + 1;
  for (const PlyElement& element : header.elements) {
    const std::uint64_t bytes = element.count * least_row_bytes(element, header.encoding);
    if (bytes > left) {
      stream.fail_at_line("the header announces " + std::to_string(element.count) + " of element " + quote(element.name) +
                          ", which need at least " + std::to_string(bytes) + " bytes, but no more than " + std::to_string(left - 1) +
                          " follow; the file is cut short");
    }
    left -= bytes;
  }
}

}  // namespace

bool PlyElement::has_list() const {
  return std::any_of(properties.begin(), properties.end(), [](const PlyProperty& p) { return p.is_list; });
}

std::size_t PlyElement::row_size() const {
  std::size_t size = 0;
  for (const PlyProperty& property : properties) size += ply_type_size(property.type);
  return size;
}

PlyHeader read_ply_header(ByteStream& stream) {
  if (stream.is_empty()) stream.fail_at_line("the file is empty");
  std::string_view line = stream.line();
  if (next_word(line) != "ply") stream.fail_at_line("not a PLY file: it does not begin with 'ply'");
  PlyHeader header;
  bool has_format = false;
  for (;;) {
    line = stream.line();
    const std::string_view keyword = next_word(line);
    if (keyword == "end_header") break;
    if (keyword == "format") {
      header.encoding = parse_encoding(stream, line);
      has_format = true;
    } else if (keyword == "element") {
      if (header.elements.size() == kMaxElements) stream.fail_at_line("more than 256 kinds of elements");
      header.elements.push_back(parse_element(stream, line));
    } else if (keyword == "property") {
      if (header.elements.empty()) stream.fail_at_line("a property before the first element");
      if (header.elements.back().properties.size() == kMaxProperties) stream.fail_at_line("more than 1024 properties");
      header.elements.back().properties.push_back(parse_property(stream, line));
    } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
      stream.fail_at_line("unknown header keyword " + quote(keyword));
    }
  }
  if (!has_format) stream.fail_at_line("the header has no format line");
  check_sizes(stream, header);
  return header;
}

}  // namespace grove
