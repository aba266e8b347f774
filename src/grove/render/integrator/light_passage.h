#pragma once

#include <cstdint>

#include "grove/render/prepared_scene.h"
#include "grove/render/sampling/sampler.h"

// Rays through what lets light pass (alpha, interfaces): what becomes of a ray at one hit. Tracing it is for others (ray_tracer.h, ray_batch.h).

namespace grove {

/// Transparent surfaces along one ray. A thick tree has some hundred; more means that coordinates are too coarse to get on.
inline constexpr int kMostPassages = 1024;

/// Whether the surface that `ray` hit stops it: a partly transparent one does by chance, and `chances_taken` counts those taken along the path. If not, `ray`
/// is what is left of it behind the surface.
[[nodiscard]] bool stops_ray(const PreparedScene& world, const Hit& hit, const Sampler& sampler, std::uint32_t& chances_taken, Ray& ray);

/// Light on its way along a ray, finite or infinite.
class LightPassage {
 public:
  explicit LightPassage(const Ray& ray);

  /// Lets the surface that `ray` hit take its part, if it was one. True when the ray, which is then what is left of it, must be traced on.
  [[nodiscard]] bool pass(const PreparedScene& world, const Hit& hit, Ray& ray);

  /// The part of the light that has come through, in [0, 1]; after kMostPassages it counts as none.
  [[nodiscard]] float transmittance() const { return passed_; }

 private:
  Vec3 end_;  // where the ray is finite
  float passed_ = 1.0F;
};

}  // namespace grove
