#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "grove/base/huge_vector.h"
#include "grove/geometry/hit.h"
#include "grove/geometry/watertight_triangle.h"
#include "grove/math/box.h"
#include "grove/math/vector.h"

namespace grove {

/// Triangles over shared vertices, made of one or more parts (a part is one mesh of a scene, one material).
///
/// During traversal a primitive is known by its number in the whole mesh, which orders by part first; `locate` turns it into
/// (geometry = part, primitive within the part). Triangles with a coordinate that is not finite, or beyond kMaxCoordinate, and those whose corners
/// are all the same vertex can never be hit and have empty bounds. Memory: 12 bytes a vertex and 12 a triangle.
///
/// A mesh may change, but numbers never do: triangles are added behind all others, and one that is removed keeps its number. Structures over the
/// mesh must be updated (Accelerator::update) before they are traced again.
class TriangleMesh {
 public:
  using PreparedRay = WatertightRay;

  TriangleMesh() = default;

  /// One part. Throws InputError when a triangle names a vertex that is not there, or there are 2^32 - 1 triangles or more.
  TriangleMesh(std::vector<Vec3> vertices, std::vector<Triangle> triangles);

  /// Appends a part whose triangles index `vertices` from 0, and returns its number.
  /// Throws as the constructor does, and leaves the mesh as it was.
  std::uint32_t add_part(std::vector<Vec3> vertices, std::vector<Triangle> triangles);

  /// Appends vertices and triangles to the last part, so that they have no part of their own; the triangles index all vertices of that part, old
  /// ones first. There must be a part. Returns the whole-mesh number of the first triangle. Throws as the constructor does, and leaves the mesh as it was.
  std::uint32_t extend_last_part(std::span<const Vec3> vertices, std::span<const Triangle> triangles);

  /// Makes triangle i one that can never be hit. It keeps its number, and all vertices stay.
  void remove_triangle(std::size_t i) { triangles_[i] = Triangle(triangles_[i].x); }

  /// Puts every vertex, over all parts, where `positions` says. Throws InputError when there are not as many as vertices().
  void move_vertices(std::span<const Vec3> positions);
  /// Puts one vertex, counted over all parts, elsewhere.
  void move_vertex(std::size_t i, const Vec3& position) { vertices_[i] = position; }

  /// Whether the corners of triangle i are all the same vertex, as those of removed ones are.
  [[nodiscard]] bool is_removed(std::size_t i) const { return triangles_[i] == Triangle(triangles_[i].x); }

  /// Number of triangles, over all parts.
  [[nodiscard]] std::size_t size() const { return triangles_.size(); }
  [[nodiscard]] std::size_t part_count() const { return part_first_triangle_.size(); }

  [[nodiscard]] std::span<const Vec3> vertices() const { return vertices_; }
  /// Indices into `vertices()`, over all parts.
  [[nodiscard]] std::span<const Triangle> triangles() const { return triangles_; }
  /// The first triangle and the first vertex of a part.
  [[nodiscard]] std::uint32_t first_triangle(std::uint32_t part) const { return part_first_triangle_[part]; }
  [[nodiscard]] std::uint32_t first_vertex(std::uint32_t part) const { return part_first_vertex_[part]; }

  /// Bounds of triangle i; empty when it can never be hit.
  [[nodiscard]] Box bounds(std::size_t i) const;

  /// Bounds of the part of triangle i inside `box`: exact up to outward rounding; empty when they do not meet.
  [[nodiscard]] Box clip(std::size_t i, const Box& box) const;

  /// Whether triangle i itself, not only its bounds, shares a point with the closed box; false when it can never be hit. Conservative by rounding in double.
  [[nodiscard]] bool overlaps(std::size_t i, const Box& box) const;

  /// As SampledGeometry asks.
  [[nodiscard]] double surface_area(std::size_t i) const;
  [[nodiscard]] glm::dvec3 surface_point(std::size_t i, double u, double v) const;

  [[nodiscard]] static PreparedRay prepare(const Ray& ray) { return WatertightRay(ray); }

  /// Tests triangle i; on a hit that is closer than `hit` (or as close, with a lower id) replaces it. `hit.primitive` is a whole-mesh
  /// number. Returns whether it did. The counter takes part only for geometries that nest others.
  template <typename Counter>
  bool intersect(std::size_t i, const PreparedRay& ray, Hit& hit, Counter& /*counter*/) const {
    const Triangle& triangle = triangles_[i];
    const auto id = static_cast<std::uint32_t>(i);
    const SingleTriangle single(vertices_[triangle.x], vertices_[triangle.y], vertices_[triangle.z]);
    return intersect_watertight(ray, single.corners, &id, hit);
  }

  /// Whether triangle i is hit with t in [ray.t_min, ray.t_max].
  template <typename Counter>
  bool occluded(std::size_t i, const PreparedRay& ray, Counter& /*counter*/) const {
    const Triangle& triangle = triangles_[i];
    const SingleTriangle single(vertices_[triangle.x], vertices_[triangle.y], vertices_[triangle.z]);
    return occluded_watertight(ray, single.corners);
  }

  /// Completes a traversal's hit: sets `geometry` and makes `primitive` count within it. O(log parts).
  void locate(Hit& hit) const;

 private:
  void check_triangles(std::span<const Triangle> triangles, std::size_t part_vertices, std::size_t new_vertices) const;
  void append(std::span<const Vec3> vertices, std::span<const Triangle> triangles, std::uint32_t first_vertex);

  HugeVector<Vec3> vertices_;
  HugeVector<Triangle> triangles_;
  std::vector<std::uint32_t> part_first_triangle_;
  std::vector<std::uint32_t> part_first_vertex_;
};

}  // namespace grove
