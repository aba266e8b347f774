#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <limits>

namespace grove {

/// The id where none applies.
inline constexpr std::uint32_t kInvalidId = 0xffffffffU;

/// Where a ray meets a primitive. 24 bytes, in the order of the hit files.
///
/// Triangles: the point is (1 - u - v) v0 + u v1 + v v2. Spheres: u and v are azimuth / 2 pi and polar angle / pi, both in [0, 1].
/// `primitive` counts within `geometry` (one part of a mesh), `geometry` within the object, `instance` within the top level;
/// `instance` is kInvalidId where there is no top level.
struct Hit {
  float t = std::numeric_limits<float>::infinity();
  float u = 0.0F;
  float v = 0.0F;
  std::uint32_t primitive = kInvalidId;
  std::uint32_t geometry = kInvalidId;
  std::uint32_t instance = kInvalidId;

  /// True where something was hit.
  [[nodiscard]] explicit operator bool() const { return primitive != kInvalidId; }

  friend bool operator==(const Hit&, const Hit&) = default;
};

static_assert(sizeof(Hit) == 24);

/// Bits, not values: +0 and -0 are different answers.
[[nodiscard]] inline bool same_bits(const Hit& a, const Hit& b) {
  using Words = std::array<std::uint32_t, 6>;
  return std::bit_cast<Words>(a) == std::bit_cast<Words>(b);
}

/// The order of candidates during a traversal, when `hit.t` starts as the ray's t_max: nearer first, then the lower primitive id. A
/// distance that is not finite is no hit.
[[nodiscard]] inline bool is_closer(float t, std::uint32_t primitive, const Hit& hit) {
  return (t < hit.t || (t == hit.t && primitive < hit.primitive)) && t < std::numeric_limits<float>::infinity();
}

}  // namespace grove
