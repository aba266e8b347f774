#include "grove/render/light/light_bounds.h"

#include <algorithm>
#include <cmath>

namespace grove {
namespace {

struct Cone {
  Vec3 axis;
  float angle;
};

// The narrowest cone around both. The result's axis lies on the great circle through both axes.
Cone joined(const Cone& a, const Cone& b) {
  const Cone& wide = a.angle >= b.angle ? a : b;
  const Cone& narrow = a.angle >= b.angle ? b : a;
  if (wide.angle >= kPi) return wide;
  const float cosine = std::clamp(glm::dot(wide.axis, narrow.axis), -1.0F, 1.0F);
  if (cosine >= 1.0F) return wide;
  const float between = std::acos(cosine);
  if (between + narrow.angle <= wide.angle) return wide;
  const float angle = 0.5F * (wide.angle + between + narrow.angle);
  const Vec3 sideways = narrow.axis - cosine * wide.axis;
  const float length = glm::length(sideways);
  // Opposite axes have no circle of their own.
  if (angle >= kPi || !(length > 1e-6F)) return {wide.axis, kPi};
  const float turn = angle - wide.angle;
  return {glm::normalize(std::cos(turn) * wide.axis + (std::sin(turn) / length) * sideways), angle};
}

}  // namespace

void LightBounds::add(const LightBounds& other) {
  if (other.is_empty()) return;
  if (is_empty()) {
    *this = other;
    return;
  }
  Vec3 direction = other.axis;
  if (is_two_sided && other.is_two_sided && glm::dot(axis, direction) < 0.0F) direction = -direction;
  const Cone cone = joined({axis, theta_o}, {direction, other.theta_o});
  axis = cone.axis;
  theta_o = cone.angle;
  theta_e = std::max(theta_e, other.theta_e);
  box.grow(other.box);
  intensity += other.intensity;
  is_two_sided = is_two_sided || other.is_two_sided;
}

float LightBounds::orientation_measure() const {
  // The integral of 1 up to theta_o and of cos(theta - theta_o) from there to theta_w, over solid angle.
  const float theta_w = std::min(theta_o + theta_e, kPi);
  const float sine = std::sin(theta_o);
  const float cosine = std::cos(theta_o);
  const float measure = 2.0F * kPi * (1.0F - cosine) +
                        0.5F * kPi * (2.0F * theta_w * sine - std::cos(theta_o - 2.0F * theta_w) - 2.0F * theta_o * sine + cosine);
  return std::min(is_two_sided ? 2.0F * measure : measure, 4.0F * kPi);
}

}  // namespace grove
