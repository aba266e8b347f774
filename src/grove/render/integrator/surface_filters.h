#pragma once

#include <cstdint>
#include <vector>

#include "grove/geometry/hit_filter.h"
#include "grove/render/prepared_scene.h"
#include "grove/render/sampling/sampler.h"

// Rays past what lets light pass (alpha, interfaces), as filters of the traversal.

namespace grove {

/// What is left of a ray from one of its hits on, that hit included.
[[nodiscard]] inline Ray from_hit_on(const Ray& ray, const Hit& hit) {
  Ray rest = ray;
  rest.t_min = hit.t;
  return rest;
}

/// Stops a ray at surfaces by the chance of their opacity. The chance of each surface is a sampler dimension of its own, so that the answer does not
/// depend on the order in which surfaces are met, and a pixel's samples are spread evenly over it. For one ray.
class ChanceFilter {
 public:
  /// `vertex` counts the surfaces that scattered the path before. Refers to its arguments.
  ChanceFilter(const PreparedScene& world, const Sampler& sampler, std::uint32_t vertex, const Ray& ray)
      : world_(&world), sampler_(&sampler), ray_(&ray), vertex_(vertex) {}

  [[nodiscard]] bool stops(const Hit& hit) const;
  [[nodiscard]] HitFilter filter() { return {accept, this}; }

 private:
  static bool accept(void* context, const Hit& hit) { return static_cast<const ChanceFilter*>(context)->stops(hit); }

  const PreparedScene* world_;
  const Sampler* sampler_;
  const Ray* ray_;
  std::uint32_t vertex_;
};

/// Stops light at surfaces that let none pass, and keeps account of the others. For one thread; it keeps its memory from ray to ray.
class LightFilter {
 public:
  explicit LightFilter(const PreparedScene& world) : world_(&world) {}

  /// Begins with another ray, which it refers to.
  void start(const Ray& ray);
  [[nodiscard]] bool stops(const Hit& hit);
  [[nodiscard]] HitFilter filter() { return {accept, this}; }

  /// The part of light that passes all the surfaces met since `start`, each counted once and multiplied in an order of their own: whatever order,
  /// and however often, the traversal met them in.
  [[nodiscard]] float transmittance();

 private:
  struct Veil {
    Hit hit;
    float transmittance;
  };

  static bool accept(void* context, const Hit& hit) { return static_cast<LightFilter*>(context)->stops(hit); }

  const PreparedScene* world_;
  const Ray* ray_ = nullptr;
  std::vector<Veil> veils_;
};

/// The part of light, in [0, 1], that comes along a ray whose nearest hit is `nearest`. `light` is memory.
[[nodiscard]] float transmittance_behind(const PreparedScene& world, const Ray& ray, const Hit& nearest, LightFilter& light);

}  // namespace grove
