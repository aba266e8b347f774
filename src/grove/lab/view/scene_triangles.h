#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "grove/scene/scene.h"

namespace grove {

/// The triangles of a scene for drawing: of spheres a few around each, of instances all in their places.
struct SceneTriangles {
  using Point = std::array<std::uint16_t, 3>;  ///< in steps of Quantiser(bounds)

  Box bounds;
  std::vector<Point> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::uint64_t total = 0;  ///< that there are in the scene
  /// Vertices were joined that share a cell of a grid with so many cells along the longest side; 0 where all are as they were.
  std::uint32_t grid = 0;
  /// One in so many triangles was looked at.
  std::uint64_t one_in = 1;
};

/// At most about `most` triangles. Where there are more, vertices that are close together are joined to one in their midst, and triangles left out of which
/// less than three corners remain (Rossignac and Borrel 1993, "Multi-resolution 3D approximations for rendering complex scenes"). So surfaces stay
/// closed and what is large stays. O(triangles); scenes of more than 16 million triangles are thinned out first.
[[nodiscard]] SceneTriangles triangles_of(const Scene& scene, std::size_t most);

}  // namespace grove
