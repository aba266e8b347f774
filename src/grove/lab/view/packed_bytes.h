#pragma once

// Numbers for pages, in few bytes: written one after another, and then as base64 text.

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "grove/math/box.h"

namespace grove {

/// Bytes that numbers are appended to; all are little-endian.
class PackedBytes {
 public:
  void add_byte(std::uint8_t value) { bytes_.push_back(value); }
  void add_u16(std::uint16_t value);
  void add_float(float value);
  /// Seven bits a byte, the lowest first; all but the last have the highest bit set (LEB128).
  void add_varint(std::uint64_t value);
  /// The same for numbers that may be negative: 0, -1, 1, -2 … become 0, 1, 2, 3 ….
  void add_signed(std::int64_t value) { add_varint(zigzag(value)); }

  [[nodiscard]] static std::uint64_t zigzag(std::int64_t value) {
    return static_cast<std::uint64_t>(value) << 1U ^ static_cast<std::uint64_t>(value >> 63);
  }

  [[nodiscard]] std::size_t size() const { return bytes_.size(); }
  /// As RFC 4648 has it, padded.
  [[nodiscard]] std::string base64() const;

 private:
  std::vector<std::uint8_t> bytes_;
};

/// Coordinates as 16-bit steps of a box: 0 is its lower end and 65535 its upper.
class Quantiser {
 public:
  static constexpr float kSteps = 65535.0F;

  /// `bounds` must be finite; where it is empty everything becomes 0.
  explicit Quantiser(const Box& bounds);

  /// The nearest step; what lies beyond the box is moved to its border, and NaN becomes 0.
  [[nodiscard]] std::uint16_t nearest(int axis, float value) const;
  /// The step at or below, and at or above: boxes only grow.
  [[nodiscard]] std::uint16_t below(int axis, float value) const;
  [[nodiscard]] std::uint16_t above(int axis, float value) const;

  void add_point(PackedBytes& bytes, const Vec3& point) const;
  /// Lower x, y, z, then upper; an empty box is one point.
  void add_box(PackedBytes& bytes, const Box& box) const;

 private:
  [[nodiscard]] double steps(int axis, float value) const;

  Box bounds_;
};

}  // namespace grove
