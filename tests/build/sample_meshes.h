#pragma once

#include <cstdint>
#include <vector>

#include "grove/base/random.h"
#include "grove/geometry/triangle_mesh.h"

namespace grove::testing {

inline Vec3 random_point(Random& random) {
  const float x = random.next_float();
  const float y = random.next_float();
  return {x, y, random.next_float()};
}

/// Long thin triangles in all directions, in the unit cube: boxes say little about them.
inline TriangleMesh slivers(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3 from = random_point(random);
    const Vec3 to = random_point(random);
    vertices.insert(vertices.end(), {from, to, to + 0.002F * random_point(random)});
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return {std::move(vertices), std::move(triangles)};
}

/// Triangles of edges of about `size` in the unit cube.
inline TriangleMesh pebbles(std::size_t count, float size, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3 centre = random_point(random);
    for (int corner = 0; corner < 3; ++corner) vertices.push_back(centre + size * (random_point(random) - 0.5F));
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return {std::move(vertices), std::move(triangles)};
}

}  // namespace grove::testing
