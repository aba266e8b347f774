#pragma once

#include <cmath>

#include "grove/math/vector.h"

namespace grove {

/// An orthonormal frame around a normal, the z axis of its local space.
struct Frame {
  Vec3 x{1.0F, 0.0F, 0.0F};
  Vec3 y{0.0F, 1.0F, 0.0F};
  Vec3 z{0.0F, 0.0F, 1.0F};

  Frame() = default;

  /// `normal` must be of unit length (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
  explicit Frame(const Vec3& normal) : z(normal) {
    const float sign = std::copysign(1.0F, z.z);
    const float a = -1.0F / (sign + z.z);
    const float b = z.x * z.y * a;
    x = Vec3(1.0F + sign * z.x * z.x * a, sign * b, -sign * z.x);
    y = Vec3(b, sign + z.y * z.y * a, -z.y);
  }

  [[nodiscard]] Vec3 to_local(const Vec3& w) const { return {glm::dot(w, x), glm::dot(w, y), glm::dot(w, z)}; }
  [[nodiscard]] Vec3 to_world(const Vec3& w) const { return w.x * x + w.y * y + w.z * z; }
};

}  // namespace grove
