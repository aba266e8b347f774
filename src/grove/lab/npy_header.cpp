#include "grove/lab/npy_header.h"

#include <array>
#include <charconv>
#include <limits>

#include "grove/base/check.h"
#include "grove/base/error.h"

namespace grove {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";
/// NumPy's own headers have 118 bytes; its reader refuses more than 10,000.
constexpr std::uint64_t kLongestHeader = 10'000;
constexpr std::size_t kDataAlignment = 64;

/// Reads the dictionary literal of a header: three keys, whose values are a string or a list, True or False, and a tuple of numbers.
class HeaderParser {
 public:
  HeaderParser(std::string_view text, std::string_view file) : text_(text), file_(file) {}

  NpyHeader parse() {
    NpyHeader header;
    bool has_descr = false;
    bool has_order = false;
    bool has_shape = false;
    expect('{');
    while (!accept('}')) {
      const std::string_view key = parse_string();
      expect(':');
      if (key == "descr") {
        header.descr = peek() == '[' ? parse_bracketed() : parse_string();
        has_descr = true;
      } else if (key == "fortran_order") {
        header.fortran_order = parse_bool();
        has_order = true;
      } else if (key == "shape") {
        header.shape = parse_shape();
        has_shape = true;
      } else {
        fail();
      }
      if (peek() != '}') expect(',');
    }
    if (peek() != '\0' || !has_descr || !has_order || !has_shape) fail();
    return header;
  }

 private:
  [[noreturn]] void fail() const {
    throw InputError(file_, "byte " + std::to_string(position_) + " of its header",
                     "the NumPy header is broken; save it again with numpy.save");
  }

  /// The next character that is not a space; 0 at the end.
  char peek() {
    while (position_ < text_.size() && (text_[position_] == ' ' || text_[position_] == '\n')) ++position_;
    return position_ < text_.size() ? text_[position_] : '\0';
  }

  bool accept(char c) {
    if (peek() != c) return false;
    ++position_;
    return true;
  }

  void expect(char c) {
    if (!accept(c)) fail();
  }

  std::string_view parse_string() {
    const char quote = peek();
    if (quote != '\'' && quote != '"') fail();
    const std::size_t first = position_ + 1;
    const std::size_t last = text_.find(quote, first);
    if (last == std::string_view::npos) fail();
    position_ = last + 1;
    return text_.substr(first, last - first);
  }

  /// The list of a structured type, as it stands.
  std::string_view parse_bracketed() {
    const std::size_t first = position_;
    int depth = 0;
    do {
      const char c = peek();
      if (c == '\0') fail();
      if (c == '\'' || c == '"') {
        parse_string();
        continue;
      }
      if (c == '[' || c == '(') ++depth;
      if (c == ']' || c == ')') --depth;
      ++position_;
    } while (depth > 0);
    return text_.substr(first, position_ - first);
  }

  bool parse_bool() {
    peek();
    for (const std::string_view word : {std::string_view("True"), std::string_view("False")}) {
      if (text_.substr(position_).starts_with(word)) {
        position_ += word.size();
        return word == "True";
      }
    }
    fail();
  }

  std::vector<std::uint64_t> parse_shape() {
    std::vector<std::uint64_t> shape;
    expect('(');
    while (!accept(')')) {
      peek();
      std::uint64_t extent = 0;
      const auto [end, error] = std::from_chars(text_.data() + position_, text_.data() + text_.size(), extent);
      if (error != std::errc()) fail();
      position_ = static_cast<std::size_t>(end - text_.data());
      shape.push_back(extent);
      if (peek() != ')') expect(',');
    }
    return shape;
  }

  std::string_view text_;
  std::string_view file_;
  std::size_t position_ = 0;
};

/// The bytes of an unsigned little-endian number.
std::uint64_t little_endian(std::span<const char> bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

}  // namespace

NpyHeader read_npy_header(std::istream& stream, std::string_view file, std::uint64_t file_size) {
  std::array<char, 12> start{};
  const auto read = [&](char* to, std::size_t size) {
    if (!stream.read(to, static_cast<std::streamsize>(size))) throw InputError(file, "", "ends within its NumPy header");
  };
  stream.read(start.data(), 8);
  if (stream.gcount() != 8 || std::string_view(start.data(), kMagic.size()) != kMagic) {
    throw InputError(file, "", "is not a NumPy array file; write it with numpy.save");
  }
  const int version = static_cast<unsigned char>(start[6]);
  if (version < 1 || version > 3) {
    throw InputError(file, "", "has NumPy format version " + std::to_string(version) + "; versions 1 to 3 can be read");
  }
  // Version 1 has a length of two bytes, later ones of four.
  const std::size_t length_size = version == 1 ? 2 : 4;
  read(start.data() + 8, length_size);
  const std::uint64_t length = little_endian(std::span(start).subspan(8, length_size));
  const std::uint64_t data_offset = 8 + length_size + length;
  if (data_offset > file_size) throw InputError(file, "", "ends within its NumPy header");
  if (length > kLongestHeader)
    throw InputError(file, "", "has a NumPy header of " + std::to_string(length) + " bytes, which cannot be right");
  std::string text(length, '\0');
  read(text.data(), text.size());
  NpyHeader header = HeaderParser(text, file).parse();
  header.data_offset = data_offset;
  return header;
}

std::string format_npy_header(std::string_view descr, std::span<const std::uint64_t> shape) {
  std::string dictionary = "{'descr': ";
  dictionary += descr;
  dictionary += ", 'fortran_order': False, 'shape': (";
  for (std::size_t i = 0; i < shape.size(); ++i) dictionary += (i > 0 ? ", " : "") + std::to_string(shape[i]);
  // A tuple of one is written (n,).
  dictionary += shape.size() == 1 ? ",), }" : "), }";
  const std::size_t start_size = kMagic.size() + 4;
  const std::size_t total = (start_size + dictionary.size() + 1 + kDataAlignment - 1) / kDataAlignment * kDataAlignment;
  dictionary.append(total - start_size - dictionary.size() - 1, ' ');
  dictionary += '\n';
  GROVE_CHECK(dictionary.size() <= std::numeric_limits<std::uint16_t>::max());

  std::string header(kMagic);
  header += '\x01';
  header += '\0';
  header += static_cast<char>(dictionary.size() & 0xff);
  header += static_cast<char>(dictionary.size() >> 8);
  return header + dictionary;
}

}  // namespace grove
