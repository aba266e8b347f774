#include "grove/build/quality/end_point_overlap.h"

#include <cmath>
#include <vector>

#include "grove/base/parallel.h"

namespace grove {
namespace {

// Points next to each other make pairs, which no border between chunks parts.
constexpr std::size_t kChunk = 1024;
static_assert(kChunk % 2 == 0);

bool contains(const Box& box, const glm::dvec3& point) {
  return point.x >= box.lower.x && point.x <= box.upper.x && point.y >= box.lower.y && point.y <= box.upper.y && point.z >= box.lower.z &&
         point.z <= box.upper.z;
}

// The times of all nodes that a ray which ends in the point enters for nothing. `contains` tells whether a node's volume contains a point.
template <typename Contains>
double wasted_time(const PreorderNodes& hierarchy, const SurfacePoint& point, const CostModel& model, const Contains& contains) {
  const std::span<const PreorderNodes::Node> nodes = hierarchy.nodes();
  double time = 0.0;
  std::uint32_t wasted_end = 0;  // nodes before it lie below one that does not hold the primitive
  for (std::uint32_t i = 0; i < nodes.size();) {
    const PreorderNodes::Node& node = nodes[i];
    if (!contains(i, point.position)) {
      i = node.end;
      continue;
    }
    if (i >= wasted_end && !hierarchy.holds(node, point.primitive)) wasted_end = node.end;
    if (i < wasted_end) time += hierarchy.is_leaf(i) ? model.intersection * node.reference_count : model.traversal;
    ++i;
  }
  return time;
}

template <typename Contains>
std::optional<SampledFigure> mean_wasted_time(const PreorderNodes& hierarchy, std::span<const SurfacePoint> points, const CostModel& model,
                                              const Contains& contains) {
  if (points.empty()) return std::nullopt;
  struct Sums {
    double times = 0.0;
    double squared_differences = 0.0;
  };
  std::vector<Sums> chunks((points.size() + kChunk - 1) / kChunk);
  parallel_chunks(points.size(), kChunk, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    Sums sums;
    double previous = 0.0;
    for (std::size_t i = first; i < last; ++i) {
      const double time = wasted_time(hierarchy, points[i], model, contains);
      sums.times += time;
      if (i % 2 == 1) sums.squared_differences += (time - previous) * (time - previous);
      previous = time;
    }
    chunks[chunk] = sums;
  });
  Sums all;
  for (const Sums& sums : chunks) {
    all.times += sums.times;
    all.squared_differences += sums.squared_differences;
  }
  // The squared difference of two points of about the same variance is twice that on average, and there are half as many pairs as points.
  const auto count = static_cast<double>(points.size());
  return SampledFigure{all.times / count, std::sqrt(all.squared_differences) / count, points.size()};
}

}  // namespace

std::optional<SampledFigure> end_point_overlap(const PreorderNodes& hierarchy, std::span<const SurfacePoint> points,
                                               const CostModel& model) {
  return mean_wasted_time(hierarchy, points, model,
                          [&](std::uint32_t node, const glm::dvec3& point) { return contains(hierarchy.nodes()[node].box, point); });
}

template <BoundingVolume V>
std::optional<SampledFigure> end_point_overlap(const PreorderNodes& hierarchy, std::span<const V> volumes,
                                               std::span<const SurfacePoint> points, const CostModel& model) {
  return mean_wasted_time(hierarchy, points, model,
                          [&](std::uint32_t node, const glm::dvec3& point) { return volumes[node].contains(point); });
}

template std::optional<SampledFigure> end_point_overlap(const PreorderNodes&, std::span<const OrientedBox>, std::span<const SurfacePoint>,
                                                        const CostModel&);
template std::optional<SampledFigure> end_point_overlap(const PreorderNodes&, std::span<const BoundingSphere>,
                                                        std::span<const SurfacePoint>, const CostModel&);

}  // namespace grove
