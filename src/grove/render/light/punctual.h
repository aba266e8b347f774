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

/// The part of a point light's or spot's intensity that is left at a distance, beside the inverse square: max(0, 1 - (distance / range)^4), as
/// KHR_lights_punctual recommends ("Range Property"); 1 for a light of infinite range.
[[nodiscard]] inline float range_window(const PunctualLight& light, float distance_squared) {
  const float x = distance_squared / (light.range * light.range);
  const float rest = 1.0F - x * x;
  return rest > 0.0F ? rest : 0.0F;
}

}  // namespace grove
