#include "grove/geometry/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "grove/base/check.h"
#include "grove/base/error.h"
#include "grove/base/parallel.h"
#include "grove/geometry/clip_triangle.h"
#include "grove/geometry/part_table.h"
#include "grove/geometry/triangle_box_overlap.h"

namespace grove {

TriangleMesh::TriangleMesh(std::vector<Vec3> vertices, std::vector<Triangle> triangles) {
  add_part(std::move(vertices), std::move(triangles));
}

// `part_vertices` is how many vertices the part will have, `new_vertices` of them added.
void TriangleMesh::check_triangles(std::span<const Triangle> triangles, std::size_t part_vertices, std::size_t new_vertices) const {
  if (vertices_.size() + new_vertices >= kInvalidId || triangles_.size() + triangles.size() >= kInvalidId)
    throw InputError("a mesh may have at most 2^32 - 2 vertices and triangles; split it into instances");
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Triangle& triangle = triangles[i];
    const std::uint32_t largest = std::max({triangle.x, triangle.y, triangle.z});
    if (largest >= part_vertices)
      throw InputError("triangle " + std::to_string(i) + " names vertex " + std::to_string(largest) + ", but there are only " +
                       std::to_string(part_vertices));
  }
}

void TriangleMesh::append(std::span<const Vec3> vertices, std::span<const Triangle> triangles, std::uint32_t first_vertex) {
  vertices_.insert(vertices_.end(), vertices.begin(), vertices.end());
  for (const Triangle& triangle : triangles) triangles_.push_back(triangle + first_vertex);
}

std::uint32_t TriangleMesh::add_part(std::vector<Vec3> vertices, std::vector<Triangle> triangles) {
  check_triangles(triangles, vertices.size(), vertices.size());
  part_first_triangle_.push_back(static_cast<std::uint32_t>(triangles_.size()));
  part_first_vertex_.push_back(static_cast<std::uint32_t>(vertices_.size()));
  append(vertices, triangles, part_first_vertex_.back());
  return static_cast<std::uint32_t>(part_count() - 1);
}

std::uint32_t TriangleMesh::extend_last_part(std::span<const Vec3> vertices, std::span<const Triangle> triangles) {
  GROVE_CHECK(part_count() > 0);
  const std::uint32_t first_vertex = part_first_vertex_.back();
  check_triangles(triangles, vertices_.size() - first_vertex + vertices.size(), vertices.size());
  const auto first = static_cast<std::uint32_t>(triangles_.size());
  append(vertices, triangles, first_vertex);
  return first;
}

void TriangleMesh::move_vertices(std::span<const Vec3> positions) {
  if (positions.size() != vertices_.size())
    throw InputError("the mesh has " + std::to_string(vertices_.size()) + " vertices, but " + std::to_string(positions.size()) +
                     " positions are given");
  parallel_ranges(positions.size(), 65536, [&](std::size_t first, std::size_t last) {
    std::copy(positions.begin() + static_cast<std::ptrdiff_t>(first), positions.begin() + static_cast<std::ptrdiff_t>(last),
              vertices_.begin() + static_cast<std::ptrdiff_t>(first));
  });
}

Box TriangleMesh::bounds(std::size_t i) const {
  Box box;
  if (is_removed(i)) return box;
  const Triangle& triangle = triangles_[i];
  for (int corner = 0; corner < 3; ++corner) {
    const Vec3& v = vertices_[triangle[corner]];
    if (!Ray::is_within(v, kMaxCoordinate)) return {};
    box.grow(v);
  }
  return box;
}

Box TriangleMesh::clip(std::size_t i, const Box& box) const {
  const Box whole = bounds(i);
  if (whole.is_empty() || box.contains(whole)) return whole;
  const Triangle& triangle = triangles_[i];
  return clip_triangle(vertices_[triangle.x], vertices_[triangle.y], vertices_[triangle.z], box);
}

bool TriangleMesh::overlaps(std::size_t i, const Box& box) const {
  if (bounds(i).is_empty()) return false;
  const Triangle& triangle = triangles_[i];
  return overlaps_box(vertices_[triangle.x], vertices_[triangle.y], vertices_[triangle.z], box);
}

double TriangleMesh::surface_area(std::size_t i) const {
  if (bounds(i).is_empty()) return 0.0;
  const Triangle& triangle = triangles_[i];
  const glm::dvec3 origin(vertices_[triangle.x]);
  return 0.5 * glm::length(glm::cross(glm::dvec3(vertices_[triangle.y]) - origin, glm::dvec3(vertices_[triangle.z]) - origin));
}

glm::dvec3 TriangleMesh::surface_point(std::size_t i, double u, double v) const {
  const Triangle& triangle = triangles_[i];
  // The strip between the first corner and the line at share s of the way to the opposite edge has the share s * s of the area.
  const double s = std::sqrt(u);
  // From one corner on, so that the points of a triangle in the plane of a box's side lie in it exactly.
  const glm::dvec3 origin(vertices_[triangle.x]);
  return origin + s * (1.0 - v) * (glm::dvec3(vertices_[triangle.y]) - origin) + s * v * (glm::dvec3(vertices_[triangle.z]) - origin);
}

void TriangleMesh::locate(Hit& hit) const {
  locate_in_parts(part_first_triangle_, hit);
}

}  // namespace grove
