#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "grove/math/vector.h"

namespace grove {

enum class PunctualLightKind : std::uint8_t { point, spot, directional };

/// A light without area, in world space (KHR_lights_punctual and pbrt's point, spot and distant).
struct PunctualLight {
  std::string name;
  PunctualLightKind kind = PunctualLightKind::point;
  Vec3 position{0.0F};
  Vec3 direction{0.0F, 0.0F, -1.0F};  ///< unit length, the way the light travels
  /// Point and spot: radiant intensity. Directional: irradiance on a surface that faces it.
  Vec3 intensity{1.0F};
  /// Spot only, radians from the axis: full strength inside inner, nothing outside outer, smooth between. inner < outer <= pi/2.
  float inner_angle = 0.0F;
  float outer_angle = 0.7853982F;
  /// Point and spot, world units: the light fades to nothing at this distance, as `range_window` (render/light/punctual.h) says. Above 0; infinite: it goes on for ever.
  float range = std::numeric_limits<float>::infinity();
};

enum class EnvironmentMapping : std::uint8_t {
  equirectangular,  ///< u along the azimuth, v from the +y pole (in environment space) down
  octahedral        ///< square, equal-area (Clarberg 2008; pbrt-v4's infinite lights), z up
};

/// Light from infinitely far away, all around. Off when radiance is 0.
struct Environment {
  /// Constant, or the factor on the image.
  Vec3 radiance{0.0F};
  std::uint32_t image = 0xffffffffU;  ///< index into Scene::images, linear RGB; none when 0xffffffff
  EnvironmentMapping mapping = EnvironmentMapping::equirectangular;
  /// Turns a world direction into the environment's space.
  Mat3 world_to_environment{1.0F};

  [[nodiscard]] bool is_on() const { return radiance.x > 0.0F || radiance.y > 0.0F || radiance.z > 0.0F; }
};

}  // namespace grove
