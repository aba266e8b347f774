#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "grove/geometry/batch_hit_filter.h"
#include "grove/geometry/hit_filter.h"
#include "grove/render/integrator/path_vertex.h"
#include "grove/render/prepared_scene.h"
#include "grove/render/sampling/sampler.h"

// Rays past what lets light pass (alpha, interfaces), as filters of the traversal.

namespace grove {

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

/// The same for a batch of paths, each with its ray.
class BatchChanceFilter {
 public:
  /// All paths have `vertex` surfaces behind them. Refers to its arguments, of equal length.
  BatchChanceFilter(const PreparedScene& world, std::span<const PathState> paths, std::uint32_t vertex, std::span<const Ray> rays)
      : world_(&world), paths_(paths), rays_(rays), vertex_(vertex) {}

  [[nodiscard]] BatchHitFilter filter() { return {accept, this}; }

 private:
  static bool accept(void* context, std::size_t ray, const Hit& hit) {
    const auto& self = *static_cast<const BatchChanceFilter*>(context);
    return ChanceFilter(*self.world_, self.paths_[ray].sampler, self.vertex_, self.rays_[ray]).stops(hit);
  }

  const PreparedScene* world_;
  std::span<const PathState> paths_;
  std::span<const Ray> rays_;
  std::uint32_t vertex_;
};

/// Stops light at surfaces that let none pass, and keeps account of the others. For one thread; it keeps its memory from batch to batch.
class LightFilter {
 public:
  explicit LightFilter(const PreparedScene& world) : world_(&world) {}

  /// Begins with other rays, which it refers to.
  void start(std::span<const Ray> rays);
  /// For any hit of those rays, and for the first of them.
  [[nodiscard]] BatchHitFilter filter() { return {accept_of_batch, this}; }
  [[nodiscard]] HitFilter filter_of_first() { return {accept_of_first, this}; }

  /// transmittances[i] becomes the part of light, in [0, 1], that comes along ray i: none where occluded[i] says that it was stopped, and else what passes
  /// all the surfaces that it has met, each counted once and multiplied in an order of their own: whatever order, and however often, the
  /// traversal met them in.
  void find_transmittances(std::span<const std::uint8_t> occluded, std::span<float> transmittances);

 private:
  struct Veil {
    std::size_t ray;
    Hit hit;
    float transmittance;
  };

  static bool accept_of_batch(void* context, std::size_t ray, const Hit& hit) {
    return static_cast<LightFilter*>(context)->stops(ray, hit);
  }
  static bool accept_of_first(void* context, const Hit& hit) { return static_cast<LightFilter*>(context)->stops(0, hit); }
  [[nodiscard]] bool stops(std::size_t ray, const Hit& hit);

  const PreparedScene* world_;
  std::span<const Ray> rays_;
  std::vector<Veil> veils_;
};

}  // namespace grove
