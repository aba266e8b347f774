#pragma once

#include <cstdint>

namespace grove {

/// Mixes the bits of a 64-bit value; a bijection with full avalanche (finaliser of SplitMix64, Steele, Lea, Flood 2014).
[[nodiscard]] constexpr std::uint64_t mix_bits(std::uint64_t v) {
  v ^= v >> 30;
  v *= 0xbf58476d1ce4e5b9ULL;
  v ^= v >> 27;
  v *= 0x94d049bb133111ebULL;
  v ^= v >> 31;
  return v;
}

/// Small deterministic generator (SplitMix64): the same seed gives the same numbers on every machine.
/// Quality is ample for scene generation and tests; not for cryptography.
class Random {
 public:
  explicit constexpr Random(std::uint64_t seed) : state_(mix_bits(seed + 0x9e3779b97f4a7c15ULL)) {}

  /// Uniform over all 64-bit values.
  constexpr std::uint64_t next_u64() {
    state_ += 0x9e3779b97f4a7c15ULL;
    return mix_bits(state_);
  }

  /// Uniform over [0, bound); `bound` > 0. Bias below bound / 2^32.
  constexpr std::uint32_t next_u32(std::uint32_t bound) { return static_cast<std::uint32_t>(((next_u64() >> 32) * bound) >> 32); }

  /// Uniform over [0, 1), a multiple of 2^-24.
  constexpr float next_float() { return static_cast<float>(next_u64() >> 40) * 0x1p-24F; }

  /// Uniform over [low, high).
  constexpr float next_float(float low, float high) { return low + (high - low) * next_float(); }

 private:
  std::uint64_t state_;
};

}  // namespace grove
