// Keyframe interpolation after glTF 2.0, appendix C: step, linear, spherical linear (Shoemake 1985, "Animating Rotation with Quaternion Curves") and cubic
// Hermite splines.

#include "grove/scene/animation/keyframes.h"

#include <algorithm>
#include <cmath>

#include "grove/math/vector.h"

namespace grove {
namespace {

glm::dvec4 unit_quaternion(std::span<const float> q) {
  const glm::dvec4 v(q[0], q[1], q[2], q[3]);
  const double length = glm::length(v);
  return length > 0.0 ? v / length : glm::dvec4(0.0, 0.0, 0.0, 1.0);
}

glm::dvec4 slerp(const glm::dvec4& from, glm::dvec4 to, double s) {
  double cosine = glm::dot(from, to);
  // q and -q are the same rotation; the nearer one makes the shorter way.
  if (cosine < 0.0) {
    to = -to;
    cosine = -cosine;
  }
  // Where the arc is as good as straight, its sine is too small to divide by.
  constexpr double kStraight = 1.0 - 1e-10;
  if (cosine > kStraight) return glm::normalize(from + s * (to - from));
  const double angle = std::acos(cosine);
  return (std::sin((1.0 - s) * angle) * from + std::sin(s * angle) * to) / std::sin(angle);
}

void store(const glm::dvec4& q, std::span<double> value) {
  for (int i = 0; i < 4; ++i) value[static_cast<std::size_t>(i)] = q[i];
}

}  // namespace

std::span<const float> KeyframeTrack::key(std::size_t i) const {
  if (interpolation == Interpolation::cubic_spline) return std::span(values).subspan((3 * i + 1) * width, width);
  return std::span(values).subspan(i * width, width);
}

// Side 0 is the tangent in, side 1 the tangent out.
std::span<const float> KeyframeTrack::tangent(std::size_t i, std::size_t side) const {
  return std::span(values).subspan((3 * i + 2 * side) * width, width);
}

void KeyframeTrack::sample(double time, std::span<double> value) const {
  const auto after = std::ranges::upper_bound(times, time, {}, [](float t) { return static_cast<double>(t); });
  const auto next = static_cast<std::size_t>(after - times.begin());
  const std::size_t last = next == 0 ? 0 : next - 1;
  if (next == 0 || next == times.size() || interpolation == Interpolation::step) {
    if (is_rotation) {
      store(unit_quaternion(key(last)), value);
    } else {
      std::ranges::copy(key(last), value.begin());
    }
    return;
  }
  const double duration = static_cast<double>(times[next]) - times[last];
  const double s = (time - times[last]) / duration;
  if (interpolation == Interpolation::linear) {
    if (is_rotation) {
      store(slerp(unit_quaternion(key(last)), unit_quaternion(key(next)), s), value);
      return;
    }
    for (std::size_t i = 0; i < width; ++i) value[i] = key(last)[i] + s * (static_cast<double>(key(next)[i]) - key(last)[i]);
    return;
  }
  const double s2 = s * s;
  const double s3 = s2 * s;
  for (std::size_t i = 0; i < width; ++i) {
    value[i] = (2.0 * s3 - 3.0 * s2 + 1.0) * key(last)[i] + duration * (s3 - 2.0 * s2 + s) * tangent(last, 1)[i] +
               (3.0 * s2 - 2.0 * s3) * key(next)[i] + duration * (s3 - s2) * tangent(next, 0)[i];
  }
  if (!is_rotation) return;
  const glm::dvec4 q(value[0], value[1], value[2], value[3]);
  const double length = glm::length(q);
  store(length > 0.0 ? q / length : glm::dvec4(0.0, 0.0, 0.0, 1.0), value);
}

}  // namespace grove
