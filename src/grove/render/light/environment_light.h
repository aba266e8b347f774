#pragma once

#include <memory>

#include "grove/render/sampling/distribution_2d.h"
#include "grove/scene/scene.h"

namespace grove {

/// The light from infinitely far away, ready to be sampled in proportion to its luminance.
class EnvironmentLight {
 public:
  struct Sample {
    Vec3 direction{0.0F};  ///< world, unit length, towards the light
    Vec3 radiance{0.0F};
    float pdf = 0.0F;  ///< with respect to solid angle
  };

  /// Black.
  EnvironmentLight() = default;
  /// Keeps the image that `environment` names.
  EnvironmentLight(const Environment& environment, std::shared_ptr<const Image> image);

  [[nodiscard]] bool is_on() const { return environment_.is_on(); }
  /// The same radiance from everywhere.
  [[nodiscard]] bool is_constant() const { return image_ == nullptr; }
  /// The radiance that arrives against `direction` (world, unit length). Bilinear between pixel centres; negative pixels count as 0.
  [[nodiscard]] Vec3 radiance(const Vec3& direction) const;
  [[nodiscard]] Sample sample(const Vec2& u) const;
  [[nodiscard]] float pdf(const Vec3& direction) const;
  /// The luminance's mean over all directions.
  [[nodiscard]] float mean_luminance() const { return mean_luminance_; }

 private:
  [[nodiscard]] Vec3 lookup(const Vec2& uv) const;
  [[nodiscard]] Vec3 pixel(std::int64_t x, std::int64_t y) const;

  Environment environment_;
  Mat3 environment_to_world_{1.0F};
  std::shared_ptr<const Image> image_;
  Distribution2D distribution_;
  float mean_luminance_ = 0.0F;
};

/// What a scene without any light is lit with: a bright, slightly blue dome over a dim ground; +y is up.
[[nodiscard]] EnvironmentLight make_default_sky();

}  // namespace grove
