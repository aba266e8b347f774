#pragma once

#include <cstdint>
#include <vector>

#include "grove/geometry/sampled_geometry.h"
#include "grove/geometry/sphere_set.h"
#include "grove/geometry/triangle_mesh.h"

namespace grove {

/// A point on a primitive.
struct SurfacePoint {
  glm::dvec3 position;
  std::uint32_t primitive;
};

/// Random points, uniform over the surfaces of a geometry: one in each of `count` strata of equal area, in order of primitive. Points are independent
/// of each other, and the same for the same seed and any number of threads. Empty where there is no surface. O(primitives + count log primitives), parallel.
template <SampledGeometry G>
[[nodiscard]] std::vector<SurfacePoint> sample_surface(const G& geometry, std::size_t count, std::uint64_t seed);

extern template std::vector<SurfacePoint> sample_surface(const TriangleMesh&, std::size_t, std::uint64_t);
extern template std::vector<SurfacePoint> sample_surface(const SphereSet&, std::size_t, std::uint64_t);

}  // namespace grove
