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

/// Lanes x, y, z; the last lane is 0.
[[nodiscard]] inline Float4 to_float4(const Vec3& v) {
  return Float4{v.x, v.y, v.z, 0.0F};
}
[[nodiscard]] inline Vec3 to_vec3(Float4 v) {
  return {v[0], v[1], v[2]};
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
