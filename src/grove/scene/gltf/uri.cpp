#include "grove/scene/gltf/uri.h"

#include <cstdint>

#include "grove/base/error.h"

namespace grove {
namespace {

constexpr int kNotADigit = -1;

int hexadecimal_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return kNotADigit;
}

// RFC 4648, and the URL-safe alphabet beside it.
int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;
  if (c == '/' || c == '_') return 63;
  return kNotADigit;
}

std::optional<std::vector<std::byte>> decode_base64(std::string_view text) {
  while (text.ends_with('=')) text.remove_suffix(1);
  std::vector<std::byte> bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int bit_count = 0;
  for (const char c : text) {
    const int digit = base64_digit(c);
    if (digit == kNotADigit) return std::nullopt;
    bits = (bits << 6) | static_cast<std::uint32_t>(digit);
    bit_count += 6;
    if (bit_count >= 8) {
      bit_count -= 8;
      bytes.push_back(static_cast<std::byte>((bits >> bit_count) & 0xffU));
    }
  }
  return bytes;
}

bool has_scheme(std::string_view uri) {
  // A colon before any slash; one letter is a drive of Windows, which is absolute too.
  const std::size_t colon = uri.find(':');
  return colon != std::string_view::npos && colon < uri.find('/');
}

}  // namespace

std::optional<std::vector<std::byte>> decode_data_uri(std::string_view uri, const std::string& file, const std::string& place) {
  if (!uri.starts_with("data:")) return std::nullopt;
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(";base64")) {
    throw InputError(file, place, "a data URI that is not base64");
  }
  std::optional<std::vector<std::byte>> bytes = decode_base64(uri.substr(comma + 1));
  if (!bytes) throw InputError(file, place, "a data URI with broken base64");
  return bytes;
}

std::filesystem::path resolve_uri(std::string_view uri, const std::string& file, const std::string& place) {
  if (has_scheme(uri) || uri.starts_with('/') || uri.empty()) {
    throw InputError(file, place, "only data URIs and paths relative to the file are read");
  }
  std::string decoded;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      decoded += uri[i];
      continue;
    }
    const int high = i + 2 < uri.size() ? hexadecimal_digit(uri[i + 1]) : kNotADigit;
    const int low = i + 2 < uri.size() ? hexadecimal_digit(uri[i + 2]) : kNotADigit;
    if (high == kNotADigit || low == kNotADigit) throw InputError(file, place, "a URI with a broken percent escape");
    decoded += static_cast<char>(high * 16 + low);
    i += 2;
  }
  if (decoded.find('\0') != std::string::npos) throw InputError(file, place, "a URI with a zero byte");
  return std::filesystem::path(file).parent_path() / decoded;
}

}  // namespace grove
