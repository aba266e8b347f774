#pragma once

// End-point overlap: Aila, Karras, Laine, "On Quality Metrics of Bounding Volume Hierarchies" (2013). A ray that ends on a surface must enter every
// node that contains the end; those that do not hold the primitive it ends on are entered for nothing. With S the surfaces of all primitives and
// Q(n) those of the primitives below node n,
//
//   EPO = sum over nodes n of C(n) area((S without Q(n)) inside the box of n) / area(S)
//
// where C(n) is the time of a step for an interior node and of testing its references for a leaf. The paper clips every primitive to every box;
// here the areas are estimated from random points on the surfaces, without bias.

#include <optional>
#include <span>

#include "grove/build/cost_model.h"
#include "grove/build/quality/preorder_nodes.h"
#include "grove/build/quality/structure_quality.h"
#include "grove/build/quality/surface_points.h"
#include "grove/math/bounding_sphere.h"
#include "grove/math/bounding_volume.h"
#include "grove/math/oriented_box.h"

namespace grove {

/// The mean over `points` (of sample_surface, for the geometry of the hierarchy) of the times of all nodes that contain a point and do not hold its
/// primitive. Boxes are closed. A primitive is held by a node when any leaf below names it, also where spatial splits have divided it. The standard error
/// comes from the differences of points next to each other (collapsed strata, Cochran, "Sampling Techniques", 1977), which overstates it, if anything. Nothing
/// without points. Parallel; the same for any number of threads. O(points * nodes that contain one).
[[nodiscard]] std::optional<SampledFigure> end_point_overlap(const PreorderNodes& hierarchy, std::span<const SurfacePoint> points,
                                                             const CostModel& model);

/// The same where other volumes than boxes bound the nodes: volumes[i] is that of node i, and the points are given in the space of the volumes.
/// A node counts where all those above it contain the point too, as otherwise no ray comes to it: of other volumes a child may stick out of its parent.
template <BoundingVolume V>
[[nodiscard]] std::optional<SampledFigure> end_point_overlap(const PreorderNodes& hierarchy, std::span<const V> volumes,
                                                             std::span<const SurfacePoint> points, const CostModel& model);

extern template std::optional<SampledFigure> end_point_overlap(const PreorderNodes&, std::span<const OrientedBox>,
                                                               std::span<const SurfacePoint>, const CostModel&);
extern template std::optional<SampledFigure> end_point_overlap(const PreorderNodes&, std::span<const BoundingSphere>,
                                                               std::span<const SurfacePoint>, const CostModel&);

}  // namespace grove
