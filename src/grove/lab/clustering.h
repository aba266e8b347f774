#pragma once

#include <optional>
#include <span>

#include "grove/math/vector.h"
#include "grove/scene/scene.h"

namespace grove {

/// How clustered points are in their bounding box: by how many times a random place is farther from the nearest point than a random point is from the nearest
/// other one, of up to 4,096 of each. After Hopkins and Skellam ("A New Method for Determining the Type of Distribution of Plant Individuals", 1954), who
/// compare sums of squares of these distances; here it is the medians, as a few points far from all others would decide a sum. 1 where the points are as
/// random as the places (standard error 0.011), less where they keep their distance, more where they crowd, without limit: for n points on a surface it
/// grows with the square root of n.
///
/// Points with a coordinate that is not finite are left out. Nothing where no two points differ, or where half of those chosen coincide with others. The
/// same for the same points, whatever the number of threads. O(n log n), in parallel in the caller's oneTBB arena.
[[nodiscard]] std::optional<double> clustering_of(std::span<const Vec3> points);

/// The same of the centroids of the primitives, in the object of a scene that has most of them, in its own space: how unevenly geometry is distributed, from
/// which the review says that octrees suffer (section III.A).
[[nodiscard]] std::optional<double> clustering_of(const Scene& scene);

}  // namespace grove
