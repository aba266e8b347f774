#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "grove/lab/batch.h"

namespace grove {

/// Rays that are traced together: first those that ask for the closest hit, then those that ask for any.
struct RaySet {
  std::string name;
  std::vector<Ray> rays;
  std::size_t closest_count = 0;  ///< at most rays.size()

  [[nodiscard]] std::size_t size() const { return rays.size(); }
  [[nodiscard]] std::span<const Ray> closest() const { return std::span(rays).first(closest_count); }
  [[nodiscard]] std::span<const Ray> any() const { return std::span(rays).subspan(closest_count); }
  /// Rays 0, stride, 2 stride and so on.
  [[nodiscard]] RaySet every(std::size_t stride) const;
};

/// Rays that all ask the same.
[[nodiscard]] RaySet ray_set(std::string name, std::vector<Ray> rays, Query query);

/// As `trace` of a batch: hits[i] answers ray i.
void trace(const Accelerator& accelerator, const RaySet& set, std::span<Hit> hits);

}  // namespace grove
