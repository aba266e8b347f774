#include "grove/lab/clustering.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "grove/base/random.h"
#include "grove/build/points/build_point_kd_tree.h"
#include "grove/geometry/enclosing_hull.h"
#include "grove/lab/largest_object.h"
#include "grove/lab/spread.h"
#include "grove/traverse/points/point_search.h"

namespace grove {
namespace {

bool is_finite(const Vec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

// The median over queries of the distance to their nearest point (rank 0), or the next.
double median_distance(const PointKdTree<3>& tree, std::span<const Point<3>> queries, std::size_t rank) {
  const std::size_t k = rank + 1;
  std::vector<PointNeighbour> nearest(k * queries.size());
  PointSearch<3>(tree).nearest(queries, k, nearest);
  std::vector<double> distances;
  distances.reserve(queries.size());
  for (std::size_t i = 0; i < queries.size(); ++i)
    distances.push_back(std::sqrt(static_cast<double>(nearest[k * i + rank].squared_distance)));
  return spread_of(std::move(distances)).median;
}

// Of the primitives that can be hit.
template <EnclosableGeometry G>
std::vector<Vec3> centroids(const G& geometry) {
  std::vector<Vec3> points;
  points.reserve(geometry.size());
  for (std::size_t i = 0; i < geometry.size(); ++i) {
    if (geometry.bounds(i).is_empty()) continue;
    const auto hull = enclosing_hull(geometry, i);
    glm::dvec3 sum(0.0);
    for (const Vec3& point : hull.points) sum += glm::dvec3(point);
    points.emplace_back(sum / static_cast<double>(hull.kPointCount));
  }
  return points;
}

}  // namespace

std::optional<double> clustering_of(std::span<const Vec3> points) {
  Box bounds;
  for (const Vec3& p : points)
    if (is_finite(p)) bounds.grow(p);
  if (bounds.is_empty()) return std::nullopt;
  // In units of the longest side, so that squares neither overflow nor vanish.
  const glm::dvec3 extent = glm::dvec3(bounds.upper) - glm::dvec3(bounds.lower);
  const double side = std::max({extent.x, extent.y, extent.z});
  if (!(side > 0.0)) return std::nullopt;
  std::vector<Point<3>> scaled;
  scaled.reserve(points.size());
  for (const Vec3& p : points) {
    if (!is_finite(p)) continue;
    const glm::vec3 q((glm::dvec3(p) - glm::dvec3(bounds.lower)) / side);
    scaled.push_back({q.x, q.y, q.z});
  }

  constexpr std::size_t kMostSamples = 4096;
  const std::size_t samples = std::min(scaled.size(), kMostSamples);
  // Of a seed that no scene is likely to be made with: places would be its points.
  Random random(0x616767726567ULL);
  std::vector<Point<3>> places(samples);
  for (Point<3>& place : places)
    for (int axis = 0; axis < 3; ++axis)
      place[static_cast<std::size_t>(axis)] = random.next_float() * static_cast<float>(extent[axis] / side);
  std::vector<Point<3>> chosen(samples);
  for (std::size_t i = 0; i < samples; ++i)
    chosen[i] = samples == scaled.size() ? scaled[i] : scaled[random.next_u32(static_cast<std::uint32_t>(scaled.size()))];

  const PointKdTree<3> tree = build_point_kd_tree<3>(scaled);
  const double from_places = median_distance(tree, places, 0);
  // The nearest to a point is itself, or one that lies in the same place.
  const double from_points = median_distance(tree, chosen, 1);
  if (!(from_points > 0.0)) return std::nullopt;
  return from_places / from_points;
}

std::optional<double> clustering_of(const Scene& scene) {
  const Object* const object = largest_object(scene);
  if (object == nullptr) return std::nullopt;
  const std::vector<Vec3> points = std::visit([](const auto& set) { return centroids(*set); }, object->geometry);
  return clustering_of(points);
}

}  // namespace grove
