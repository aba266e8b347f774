#pragma once

#include "grove/accel/volume_bvh.h"
#include "grove/build/quality/end_point_overlap.h"
#include "grove/build/quality/sibling_overlap.h"

namespace grove {

struct QualitySettings {
  CostModel cost = {};
  /// Points that the end-point overlap is estimated from: the standard error is then about 1 % on the built-in scenes, and a million triangles
  /// take less than half a second on two threads, most of it to list the nodes.
  std::size_t sample_count = std::size_t{1} << 18;
  std::uint64_t seed = 1;
};

/// All figures of a hierarchy over a geometry. `Hierarchy` has references and visit(box, depth, first, count) in depth-first order, as Bvh2. Parallel; the
/// same for any number of threads.
template <typename Hierarchy, Geometry G>
[[nodiscard]] StructureQuality measure_quality(const Hierarchy& hierarchy, const G& geometry, const QualitySettings& settings = {}) {
  const PreorderNodes nodes(hierarchy, geometry.size());
  StructureQuality quality;
  quality.sibling_overlap = sibling_overlap(nodes);
  quality.duplication = nodes.duplication();
  if constexpr (SampledGeometry<G>)
    quality.end_point_overlap = end_point_overlap(nodes, sample_surface(geometry, settings.sample_count, settings.seed), settings.cost);
  return quality;
}

/// The same for other volumes than boxes. Sibling overlap is missing: it is told by boxes, and those around other volumes say little about them.
template <BoundingVolume V, Geometry G>
[[nodiscard]] StructureQuality measure_quality(const VolumeBvh<V>& hierarchy, const G& geometry, const QualitySettings& settings = {}) {
  const PreorderNodes nodes(hierarchy, geometry.size());
  StructureQuality quality;
  quality.duplication = nodes.duplication();
  if constexpr (SampledGeometry<G>) {
    std::vector<V> volumes;
    volumes.reserve(nodes.nodes().size());
    hierarchy.visit_nodes([&](const VolumeNode<V>& node, std::uint32_t /*depth*/) { volumes.push_back(node.volume); });
    std::vector<SurfacePoint> points = sample_surface(geometry, settings.sample_count, settings.seed);
    for (SurfacePoint& point : points) point.position = hierarchy.space.to_unit(point.position);
    quality.end_point_overlap = end_point_overlap<V>(nodes, volumes, points, settings.cost);
  }
  return quality;
}

}  // namespace grove
