#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace grove {

/// How values between keyframes are found (glTF 2.0 appendix C).
enum class Interpolation : std::uint8_t {
  step,         ///< that of the keyframe before
  linear,       ///< on the straight line; quaternions on the shorter arc (slerp, Shoemake 1985)
  cubic_spline  ///< a Hermite spline; each keyframe has tangents
};

/// A value that changes with time, given at some times.
struct KeyframeTrack {
  Interpolation interpolation = Interpolation::linear;
  /// Four numbers x, y, z, w that stand for a rotation: they are interpolated as such and come out of unit length.
  bool is_rotation = false;
  std::uint32_t width = 1;    ///< numbers in a value
  std::vector<float> times;   ///< seconds, finite, strictly increasing, at least one
  std::vector<float> values;  ///< `width` numbers a keyframe; with cubic_spline three times as many: tangent in, value, tangent out

  /// The value at a time; before the first keyframe and after the last it is theirs. `value` has room for `width` numbers.
  /// O(log keyframes), any number of threads.
  void sample(double time, std::span<double> value) const;

 private:
  [[nodiscard]] std::span<const float> key(std::size_t i) const;
  [[nodiscard]] std::span<const float> tangent(std::size_t i, std::size_t side) const;
};

}  // namespace grove
