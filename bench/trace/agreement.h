#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "grove/geometry/hit.h"
#include "grove/geometry/ray.h"
#include "grove/geometry/triangle_mesh.h"

namespace grove::bench {

/// How two contenders' closest hits compare, judged by exact arithmetic where they differ.
struct Agreement {
  std::size_t rays = 0;
  std::size_t hits = 0;       ///< of the first contender
  std::size_t agreeing = 0;   ///< both miss, or both hit with t within 1e-4 relative
  std::size_t grazing = 0;    ///< differ, and the nearer hit lies within rounding of its triangle's edge, or the triangle is seen edge-on
  std::size_t imprecise = 0;  ///< the same triangle, but the second's t is off from the exact one by more than 1e-4
  std::size_t unexplained = 0;
  std::vector<std::string> examples;  ///< of what is unexplained, at most five
};

/// `hits` are compared to `rival_hits`; both name triangles of `mesh`.
[[nodiscard]] Agreement compare_hits(const TriangleMesh& mesh, std::span<const Ray> rays, std::span<const Hit> hits,
                                     std::span<const Hit> rival_hits);

}  // namespace grove::bench
