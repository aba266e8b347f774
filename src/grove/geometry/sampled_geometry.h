#pragma once

#include <concepts>
#include <cstddef>

#include "grove/geometry/geometry_concept.h"

namespace grove {

/// A geometry whose surfaces can be measured and sampled, for figures that depend on where surfaces are and not only on where boxes are.
///
/// `surface_area(i)` is the area of primitive i, 0 for one that can never be hit. `surface_point(i, u, v)` is a point on it, uniform by
/// area when (u, v) is uniform over the unit square; only for primitives with an area.
template <typename G>
concept SampledGeometry = Geometry<G> && requires(const G& geometry, std::size_t i, double u, double v) {
  { geometry.surface_area(i) } -> std::same_as<double>;
  { geometry.surface_point(i, u, v) } -> std::same_as<glm::dvec3>;
};

}  // namespace grove
