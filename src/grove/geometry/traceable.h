#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "grove/geometry/batch_hit_filter.h"
#include "grove/geometry/hit.h"
#include "grove/geometry/hit_filter.h"
#include "grove/geometry/ray.h"
#include "grove/geometry/traversal_counts.h"
#include "grove/math/box.h"

namespace grove {

/// The small interface that an instance refers to: something a ray can be traced at. Every Accelerator is one.
/// All functions may be called by many threads at once.
class Traceable {
 public:
  virtual ~Traceable() = default;

  /// Encloses everything that can be hit; empty when nothing can.
  [[nodiscard]] virtual Box bounds() const = 0;

  /// The closest hit with t in [ray.t_min, ray.t_max], ties to the lowest (geometry, primitive); a Hit with t = infinity on a miss.
  /// Adds to `*counts` when it is not null.
  [[nodiscard]] virtual Hit closest_hit(const Ray& ray, TraversalCounts* counts) const = 0;

  /// True when anything is hit with t in [ray.t_min, ray.t_max]. Adds to `*counts` when it is not null.
  [[nodiscard]] virtual bool any_hit(const Ray& ray, TraversalCounts* counts) const = 0;

  /// closest_hit and any_hit of many rays: hits[i] and results[i] (1 or 0) answer rays[i]. The spans must be of equal length.
  virtual void closest_hits(std::span<const Ray> rays, std::span<Hit> hits) const {
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = closest_hit(rays[i], nullptr);
  }
  virtual void any_hits(std::span<const Ray> rays, std::span<std::uint8_t> results) const {
    for (std::size_t i = 0; i < rays.size(); ++i) results[i] = any_hit(rays[i], nullptr) ? 1 : 0;
  }

  /// The closest hit, and whether there is any, among those that `filter` accepts.
  [[nodiscard]] virtual Hit closest_hit(const Ray& ray, const HitFilter& filter) const = 0;
  [[nodiscard]] virtual bool any_hit(const Ray& ray, const HitFilter& filter) const = 0;

  /// The same of many rays, which the filter is told by their numbers in `rays`. The spans must be of equal length.
  virtual void closest_hits(std::span<const Ray> rays, std::span<Hit> hits, const BatchHitFilter& filter) const {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      FilterOfOneRay of_one(filter, i);
      hits[i] = closest_hit(rays[i], of_one.filter());
    }
  }
  virtual void any_hits(std::span<const Ray> rays, std::span<std::uint8_t> results, const BatchHitFilter& filter) const {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      FilterOfOneRay of_one(filter, i);
      results[i] = any_hit(rays[i], of_one.filter()) ? 1 : 0;
    }
  }
};

}  // namespace grove
