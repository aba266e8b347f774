#pragma once

// The end-point overlap of a small hierarchy, exactly: every triangle is clipped to every box. O(nodes * triangles).

#include <vector>

#include "grove/build/cost_model.h"
#include "grove/build/quality/preorder_nodes.h"
#include "grove/geometry/triangle_mesh.h"

namespace grove::testing {

using Polygon = std::vector<glm::dvec3>;

/// The part where sign * (coordinate - plane) >= 0 (Sutherland and Hodgman 1974).
inline Polygon clip_half_space(const Polygon& polygon, int axis, double plane, double sign) {
  Polygon inside;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3& a = polygon[i];
    const glm::dvec3& b = polygon[(i + 1) % polygon.size()];
    const double distance_a = sign * (a[axis] - plane);
    const double distance_b = sign * (b[axis] - plane);
    if (distance_a >= 0.0) inside.push_back(a);
    if ((distance_a >= 0.0) != (distance_b >= 0.0)) inside.push_back(a + distance_a / (distance_a - distance_b) * (b - a));
  }
  return inside;
}

inline double area_inside(Polygon polygon, const Box& box) {
  for (int axis = 0; axis < 3; ++axis) {
    polygon = clip_half_space(polygon, axis, box.lower[axis], 1.0);
    polygon = clip_half_space(polygon, axis, box.upper[axis], -1.0);
  }
  glm::dvec3 sum(0.0);
  for (std::size_t i = 2; i < polygon.size(); ++i) sum += glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return 0.5 * glm::length(sum);
}

template <typename Hierarchy>
double exact_end_point_overlap(const Hierarchy& hierarchy, const TriangleMesh& mesh, const CostModel& model) {
  std::vector<Polygon> polygons;
  double whole = 0.0;
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    Polygon& polygon = polygons.emplace_back();
    for (int corner = 0; corner < 3; ++corner) polygon.emplace_back(mesh.vertices()[mesh.triangles()[i][corner]]);
    whole += area_inside(polygon, mesh.bounds(i));
  }
  const PreorderNodes nodes(hierarchy, mesh.size());
  double sum = 0.0;
  for (std::uint32_t i = 0; i < nodes.nodes().size(); ++i) {
    const PreorderNodes::Node& node = nodes.nodes()[i];
    double area = 0.0;
    for (std::uint32_t primitive = 0; primitive < mesh.size(); ++primitive)
      if (!nodes.holds(node, primitive)) area += area_inside(polygons[primitive], node.box);
    sum += area * (nodes.is_leaf(i) ? model.intersection * node.reference_count : model.traversal);
  }
  return sum / whole;
}

}  // namespace grove::testing
