#include "grove/scene/formats/ply_numbers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <string>

#include "grove/scene/formats/text.h"

namespace grove {
namespace {

template <typename T>
T load(const std::byte* data, bool swap) {
  std::array<std::byte, sizeof(T)> bytes;
  std::memcpy(bytes.data(), data, sizeof(T));
  if (swap) std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<T>(bytes);
}

// A double beyond the range of float becomes infinite, and so a vertex that no triangle can be hit at.
float narrow(double value) {
  constexpr double limit = std::numeric_limits<float>::max();
  if (value > limit || value < -limit) return std::copysign(std::numeric_limits<float>::infinity(), static_cast<float>(value > 0) - 0.5F);
  return static_cast<float>(value);
}

std::int64_t load_integer(const std::byte* data, PlyType type, bool swap) {
  switch (type) {
    case PlyType::int8:
      return load<std::int8_t>(data, swap);
    case PlyType::uint8:
      return load<std::uint8_t>(data, swap);
    case PlyType::int16:
      return load<std::int16_t>(data, swap);
    case PlyType::uint16:
      return load<std::uint16_t>(data, swap);
    case PlyType::int32:
      return load<std::int32_t>(data, swap);
    default:
      return load<std::uint32_t>(data, swap);
  }
}

}  // namespace

float load_ply_float(const std::byte* data, PlyType type, bool swap) {
  switch (type) {
    case PlyType::int8:
      return load<std::int8_t>(data, swap);
    case PlyType::uint8:
      return load<std::uint8_t>(data, swap);
    case PlyType::int16:
      return load<std::int16_t>(data, swap);
    case PlyType::uint16:
      return load<std::uint16_t>(data, swap);
    case PlyType::int32:
      return static_cast<float>(load<std::int32_t>(data, swap));
    case PlyType::uint32:
      return static_cast<float>(load<std::uint32_t>(data, swap));
    case PlyType::float32:
      return load<float>(data, swap);
    case PlyType::float64:
      return narrow(load<double>(data, swap));
  }
  return 0.0F;
}

PlyNumbers::PlyNumbers(ByteStream& stream, PlyEncoding encoding)
    : stream_(stream),
      text_(encoding == PlyEncoding::ascii),
      swap_((encoding == PlyEncoding::big_endian) != (std::endian::native == std::endian::big)) {}

float PlyNumbers::next_float(PlyType type) {
  if (!text_) return load_ply_float(stream_.take(ply_type_size(type)), type, swap_);
  const std::string_view word = stream_.word();
  const std::optional<float> value = parse_float(word);
  if (!value) fail(quote(word) + " is not a number");
  return *value;
}

std::int64_t PlyNumbers::next_integer(PlyType type) {
  if (!text_) return load_integer(stream_.take(ply_type_size(type)), type, swap_);
  const std::string_view word = stream_.word();
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) fail(quote(word) + " is not an integer");
  return value;
}

std::uint64_t PlyNumbers::next_list_length(const PlyProperty& property) {
  const std::int64_t length = next_integer(property.count_type);
  if (length < 0) fail("a list of negative length");
  const std::uint64_t least = static_cast<std::uint64_t>(length) * (text_ ? 1 : ply_type_size(property.type));
  if (length > 0xffffffffLL || least > stream_.remaining_at_most()) {
    fail("a list of " + std::to_string(length) + " entries is longer than the rest of the file");
  }
  return static_cast<std::uint64_t>(length);
}

void PlyNumbers::skip(const PlyProperty& property) {
  const std::uint64_t count = property.is_list ? next_list_length(property) : 1;
  if (!text_) return stream_.skip(count * ply_type_size(property.type));
  for (std::uint64_t i = 0; i < count; ++i) stream_.word();
}

void PlyNumbers::fail(std::string_view problem) const {
  if (text_) stream_.fail_at_line(problem);
  stream_.fail_at_byte(problem);
}

}  // namespace grove
