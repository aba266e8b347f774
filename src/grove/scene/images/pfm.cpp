// Portable float map: "PF" (three channels) or "Pf" (one), width, height and a scale in ASCII, then rows of 32-bit floats from the
// bottom up; a negative scale means little-endian. The scale's size is a unit of measure that nobody writes: it is ignored.
#include <bit>
#include <charconv>
#include <cstring>
#include <string_view>

#include "grove/base/error.h"
#include "grove/scene/images/decode.h"

namespace grove {
namespace {

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

// Takes the next word off `text`; empty when there is none, or none of a number's length.
std::string_view take_word(std::string_view& text) {
  constexpr std::size_t kLongestWord = 64;
  std::size_t first = 0;
  while (first < text.size() && is_space(text[first])) ++first;
  std::size_t last = first;
  while (last < text.size() && last - first < kLongestWord && !is_space(text[last])) ++last;
  const std::string_view word = text.substr(first, last - first);
  text.remove_prefix(last);
  return word;
}

template <typename Number>
Number take_number(std::string_view& text, const std::string& name) {
  const std::string_view word = take_word(text);
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty() || error != std::errc() || end != word.data() + word.size()) {
    throw InputError(name, "PFM header", "expected width, height and scale as numbers");
  }
  return value;
}

float decode_float(const char* bytes, bool swap) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, bytes, sizeof(bits));
  if (swap) bits = (bits >> 24) | ((bits >> 8) & 0xff00U) | ((bits << 8) & 0xff0000U) | (bits << 24);
  return std::bit_cast<float>(bits);
}

}  // namespace

Image decode_pfm(std::span<const std::byte> data, const std::string& name) {
  std::string_view text(reinterpret_cast<const char*>(data.data()), data.size());
  Image image;
  image.channels = take_word(text) == "PF" ? 3 : 1;
  image.width = take_number<std::uint32_t>(text, name);
  image.height = take_number<std::uint32_t>(text, name);
  const auto scale = take_number<double>(text, name);
  // Exactly one space character ends the header; what follows are numbers that may look like spaces.
  if (!text.empty()) text.remove_prefix(1);

  check_image_size(image.width, image.height, data.size(), 1, name);
  const std::size_t row = std::size_t{image.width} * image.channels;
  if (text.size() / sizeof(float) / row < image.height) {
    throw InputError(name, "", "ends before its last row; the file is cut short");
  }
  const bool swap = (scale < 0.0) != (std::endian::native == std::endian::little);
  image.floats.resize(row * image.height);
  for (std::size_t y = 0; y < image.height; ++y) {
    const char* source = text.data() + (image.height - 1 - y) * row * sizeof(float);
    for (std::size_t i = 0; i < row; ++i) image.floats[y * row + i] = decode_float(source + i * sizeof(float), swap);
  }
  return image;
}

}  // namespace grove
