#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

#include "grove/base/random.h"

namespace grove {

/// A 64-bit hash of a sequence of pieces, against accidents, not against attack: equal on every little-endian machine for the same pieces
/// in the same order, and different for others but for one chance in 2^64. Where one piece ends and the next begins counts. About 1.5 GB/s.
class Hash {
 public:
  void add_bytes(const void* bytes, std::size_t size) {
    const auto* place = static_cast<const unsigned char*>(bytes);
    std::size_t left = size;
    for (; left >= sizeof(std::uint64_t); left -= sizeof(std::uint64_t), place += sizeof(std::uint64_t))
      add_word(place, sizeof(std::uint64_t));
    if (left > 0) add_word(place, left);
    mix(size);
  }

  /// Numbers, enumerations and plain structures of them, which must have no padding: its bytes are undefined.
  template <typename T>
  requires std::is_trivially_copyable_v<T> &&(!std::is_pointer_v<T>)void add(const T& value) { add_bytes(&value, sizeof(T)); }

  template <typename T>
  requires std::is_trivially_copyable_v<T>
  void add_all(std::span<const T> values) { add_bytes(values.data(), values.size_bytes()); }

  [[nodiscard]] std::uint64_t value() const { return mix_bits(state_); }

 private:
  void add_word(const unsigned char* bytes, std::size_t size) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes, size);
    mix(word);
  }
  // The odd constant keeps runs of zeros from leaving the state at zero.
  void mix(std::uint64_t word) { state_ = mix_bits(state_ ^ word) + 0x9e3779b97f4a7c15ULL; }

  std::uint64_t state_ = 0;
};

}  // namespace grove
