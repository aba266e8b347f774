#pragma once

#include <algorithm>
#include <cmath>

#include "grove/scene/light.h"

namespace grove {

/// The part of a light's intensity that goes towards `direction` (unit length, away from the light): 1 but for spots, which fall off
/// smoothly (cubic in the cosine) between the inner and the outer angle.
[[nodiscard]] inline float punctual_falloff(const PunctualLight& light, const Vec3& direction) {
  if (light.kind != PunctualLightKind::spot) return 1.0F;
  const float cosine = glm::dot(direction, light.direction);
  const float outer = std::cos(light.outer_angle);
  const float inner = std::cos(light.inner_angle);
  if (cosine <= outer) return 0.0F;
  if (cosine >= inner) return 1.0F;
  const float x = (cosine - outer) / (inner - outer);
  return x * x * (3.0F - 2.0F * x);
}

}  // namespace grove
