#pragma once

// Four floats in one register, by the vector extension that GCC and Clang share: SSE on x86, NEON on ARM. For box arithmetic in builders
// and in the binary traversal. Kernels that need more (wider registers, run-time choice of the instruction set) live in traverse/simd.

#include <bit>
#include <cstdint>
#include <cstring>

#include "grove/math/box.h"

namespace grove {

using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));

[[nodiscard]] inline Float4 splat(float v) {
  return Float4{v, v, v, v};
}

/// Lane by lane: a < b ? a : b; b where either is NaN.
[[nodiscard]] inline Float4 min(Float4 a, Float4 b) {
  return a < b ? a : b;
}
/// Lane by lane: a > b ? a : b; b where either is NaN.
[[nodiscard]] inline Float4 max(Float4 a, Float4 b) {
  return a > b ? a : b;
}

/// Bit 0 and 1: whether lanes 0 and 1 of a comparison are true.
[[nodiscard]] inline int first_two_lanes(Int4 mask) {
#ifdef __SSE__
  return __builtin_ia32_movmskps(reinterpret_cast<Float4>(mask)) & 3;
#else
  return (mask[0] & 1) | (mask[1] & 2);
#endif
}

/// Bits 0 to 2: whether lanes 0 to 2 of a comparison are true.
[[nodiscard]] inline int first_three_lanes(Int4 mask) {
#ifdef __SSE__
  return __builtin_ia32_movmskps(reinterpret_cast<Float4>(mask)) & 7;
#else
  return (mask[0] & 1) | (mask[1] & 2) | (mask[2] & 4);
#endif
}

/// Bit i: whether lane i of a comparison is true.
[[nodiscard]] inline int four_lanes(Int4 mask) {
#ifdef __SSE__
  return __builtin_ia32_movmskps(reinterpret_cast<Float4>(mask));
#else
  return (mask[0] & 1) | (mask[1] & 2) | (mask[2] & 4) | (mask[3] & 8);
#endif
}

/// Unaligned.
[[nodiscard]] inline Float4 load4(const float* p) {
  Float4 v;
  std::memcpy(&v, p, sizeof v);
  return v;
}

/// Unaligned.
inline void store4(Float4 v, float* p) {
  std::memcpy(p, &v, sizeof v);
}

/// Rows become columns.
inline void transpose(Float4 row[4]) {
  const Float4 a = __builtin_shufflevector(row[0], row[1], 0, 4, 1, 5);
  const Float4 b = __builtin_shufflevector(row[2], row[3], 0, 4, 1, 5);
  const Float4 c = __builtin_shufflevector(row[0], row[1], 2, 6, 3, 7);
  const Float4 d = __builtin_shufflevector(row[2], row[3], 2, 6, 3, 7);
  row[0] = __builtin_shufflevector(a, b, 0, 1, 4, 5);
  row[1] = __builtin_shufflevector(a, b, 2, 3, 6, 7);
  row[2] = __builtin_shufflevector(c, d, 0, 1, 4, 5);
  row[3] = __builtin_shufflevector(c, d, 2, 3, 6, 7);
}

/// Lanes x, y, z; the last lane is 0.
[[nodiscard]] inline Float4 to_float4(const Vec3& v) {
  return Float4{v.x, v.y, v.z, 0.0F};
}
[[nodiscard]] inline Vec3 to_vec3(Float4 v) {
  return {v[0], v[1], v[2]};
}

/// The last lane, which boxes and points leave free, as the bits of a number.
[[nodiscard]] inline std::uint32_t last_lane_bits(Float4 v) {
  return std::bit_cast<std::uint32_t>(static_cast<float>(v[3]));
}
[[nodiscard]] inline Float4 with_last_lane_bits(Float4 v, std::uint32_t bits) {
  Int4 lanes = reinterpret_cast<Int4>(v);
  lanes[3] = static_cast<std::int32_t>(bits);
  return reinterpret_cast<Float4>(lanes);
}
/// Clears the last lane: the bits of a number may be a denormal float, and arithmetic on denormals is slow.
[[nodiscard]] inline Float4 without_last_lane(Float4 v) {
  constexpr Int4 kKeepCoordinates = {-1, -1, -1, 0};
  return reinterpret_cast<Float4>(reinterpret_cast<Int4>(v) & kKeepCoordinates);
}

/// A box in two registers. The last lanes are free for other use: they take part in nothing.
struct Box4 {
  Float4 lower;
  Float4 upper;

  [[nodiscard]] static Box4 empty() {
    const float infinity = std::numeric_limits<float>::infinity();
    return {splat(infinity), splat(-infinity)};
  }
  void grow(const Box4& other) {
    lower = min(other.lower, lower);
    upper = max(other.upper, upper);
  }
  void grow(Float4 point) {
    lower = min(point, lower);
    upper = max(point, upper);
  }
  [[nodiscard]] Box box() const { return {to_vec3(lower), to_vec3(upper)}; }
};

}  // namespace grove
