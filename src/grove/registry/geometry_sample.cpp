#include "grove/registry/geometry_sample.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "grove/base/random.h"
#include "grove/geometry/geometry_concept.h"

namespace grove {
namespace {

constexpr std::size_t kLines = 256;
constexpr std::size_t kPrimitives = 2048;

template <typename G>
constexpr GeometryKind kKindOf = std::same_as<G, TriangleMesh>  ? GeometryKind::triangles
                                 : std::same_as<G, SphereSet>   ? GeometryKind::spheres
                                 : std::same_as<G, InstanceSet> ? GeometryKind::instances
                                                                : GeometryKind::user;

/// Whether the line from `ray` on meets the box. Slabs in double: a rough answer would do, but not NaN.
bool meets(const Ray& ray, const Box& box) {
  double near = 0.0;
  double far = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double origin = ray.origin[axis];
    const double direction = ray.direction[axis];
    if (direction == 0.0) {
      if (origin < box.lower[axis] || origin > box.upper[axis]) return false;
      continue;
    }
    const double a = (box.lower[axis] - origin) / direction;
    const double b = (box.upper[axis] - origin) / direction;
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  return near <= far;
}

/// Lines through uniform places in the box, in uniform directions, that begin outside it.
std::vector<Ray> lines_through(const Box& box) {
  Random random(1);
  const glm::dvec3 lower(box.lower);
  const glm::dvec3 extent = glm::dvec3(box.upper) - lower;
  const double diagonal = glm::length(extent);
  std::vector<Ray> lines(kLines);
  for (Ray& line : lines) {
    glm::dvec3 place(0.0);
    for (int axis = 0; axis < 3; ++axis) place[axis] = lower[axis] + extent[axis] * random.next_float();
    const double z = random.next_float(-1.0F, 1.0F);
    const double azimuth = 2.0 * 3.14159265358979 * random.next_float();
    const double radius = std::sqrt(std::max(0.0, 1.0 - z * z));
    const glm::dvec3 direction(radius * std::cos(azimuth), radius * std::sin(azimuth), z);
    line.origin = Vec3(place - diagonal * direction);
    line.direction = Vec3(direction);
  }
  return lines;
}

template <Geometry G>
GeometrySample sample(const G& geometry) {
  GeometrySample result;
  result.kind = kKindOf<G>;
  result.size = geometry.size();
  Box bounds;
  std::vector<std::size_t> chosen;
  const std::size_t step = std::max<std::size_t>(1, result.size / kPrimitives);
  for (std::size_t i = 0; i < result.size; i += step) {
    const Box box = geometry.bounds(i);
    if (box.is_empty()) continue;
    bounds.grow(box);
    chosen.push_back(i);
  }
  if (chosen.empty()) return result;
  std::size_t boxes = 0;
  std::size_t hits = 0;
  NoCounter counter;
  for (const Ray& line : lines_through(bounds)) {
    const typename G::PreparedRay prepared = geometry.prepare(line);
    for (const std::size_t i : chosen) {
      if (!meets(line, geometry.bounds(i))) continue;
      ++boxes;
      hits += geometry.occluded(i, prepared, counter) ? 1 : 0;
    }
  }
  const double scale = static_cast<double>(result.size) / static_cast<double>(chosen.size()) / static_cast<double>(kLines);
  result.boxes_per_line = scale * static_cast<double>(boxes);
  result.hits_per_line = scale * static_cast<double>(hits);
  return result;
}

}  // namespace

GeometrySample sample_geometry(const GeometryPointer& geometry) {
  return std::visit([](const auto& set) { return sample(*set); }, geometry);
}

}  // namespace grove
