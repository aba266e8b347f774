#include "grove/geometry/watertight_triangle.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace grove {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Half a unit in the last place of 1: the relative error of one float operation.
using DVec3 = glm::dvec3;

// The edge functions of a triangle whose sheared corners are given, as weights of the corners.
DVec3 edge_weights(const DVec3& x, const DVec3& y) {
  return {x[2] * y[1] - x[1] * y[2], x[0] * y[2] - x[2] * y[0], x[1] * y[0] - x[0] * y[1]};
}

DVec3 to_double(Float4 v) {
  return {v[0], v[1], v[2]};
}

// The largest coordinate of the corners relative to the origin.
double largest_coordinate(const DVec3& p0, const DVec3& p1, const DVec3& p2) {
  const DVec3 largest = glm::max(glm::max(glm::abs(p0), glm::abs(p1)), glm::abs(p2));
  return std::max({largest.x, largest.y, largest.z});
}

// The ray against the triangle without the rounding of the shear: the distance (times the largest component of the direction) where it
// passes the triangle, or NaN where it passes outside or doubles do not suffice to tell. All along kx, ky and kz.
double exact_depth(const DVec3& direction, const DVec3& p0, const DVec3& p1, const DVec3& p2, double tolerance) {
  const DVec3 z(p0.z, p1.z, p2.z);
  const DVec3 x = DVec3(p0.x, p1.x, p2.x) - direction.x / direction.z * z;
  const DVec3 y = DVec3(p0.y, p1.y, p2.y) - direction.y / direction.z * z;
  const DVec3 edges = edge_weights(x, y);
  const double sum = edges.x + edges.y + edges.z;
  const DVec3 weights = edges / sum;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  if (!(weights.x >= 0.0 && weights.y >= 0.0 && weights.z >= 0.0)) return kNan;
  const bool on_the_ray = std::fabs(glm::dot(weights, x)) <= tolerance && std::fabs(glm::dot(weights, y)) <= tolerance;
  return on_the_ray ? glm::dot(weights, z) : kNan;
}

}  // namespace

WatertightRay::WatertightRay(const Ray& r) : ray(r) {
  const Vec3 d(std::fabs(r.direction.x), std::fabs(r.direction.y), std::fabs(r.direction.z));
  kz = d.x > d.y ? (d.x > d.z ? 0 : 2) : (d.y > d.z ? 1 : 2);
  kx = (kz + 1) % 3;
  ky = (kx + 1) % 3;
  if (r.direction[kz] < 0.0F) {
    const int swap = kx;
    kx = ky;
    ky = swap;
  }
  origin_x = splat(r.origin[kx]);
  origin_y = splat(r.origin[ky]);
  origin_z = splat(r.origin[kz]);
  shear_x = splat(r.direction[kx] / r.direction[kz]);
  shear_y = splat(r.direction[ky] / r.direction[kz]);
}

bool watertight::test_edges_in_double(const ShearedCorners& sheared, Edges& edges) {
  const DVec3 weights = edge_weights(to_double(sheared.x), to_double(sheared.y));
  const bool all_positive = weights.x >= 0.0 && weights.y >= 0.0 && weights.z >= 0.0;
  const bool all_negative = weights.x <= 0.0 && weights.y <= 0.0 && weights.z <= 0.0;
  if (!all_positive && !all_negative) return false;
  const double sum = weights.x + weights.y + weights.z;
  if (sum == 0.0) return false;  // the triangle is a line or a point as seen from the ray
  // Normalised, so that they are good floats at any scale.
  edges = {static_cast<float>(weights.x / sum), static_cast<float>(weights.y / sum), static_cast<float>(weights.z / sum)};
  return true;
}

float watertight::hit_distance(const WatertightRay& ray, const TriangleCorners& corners, const ShearedCorners& sheared) {
  // Along kx, ky and kz: the order in which sums are rounded is that of the wide kernels, which have the axes like this.
  const auto in_order = [&](const Vec3& v) { return DVec3(v[ray.kx], v[ray.ky], v[ray.kz]); };
  const DVec3 origin = in_order(ray.ray.origin);
  const DVec3 direction = in_order(ray.ray.direction);
  const DVec3 p0 = in_order(corners.corner(0)) - origin;
  const DVec3 p1 = in_order(corners.corner(1)) - origin;
  const DVec3 p2 = in_order(corners.corner(2)) - origin;
  const DVec3 normal = glm::cross(p1 - p0, p2 - p0);
  const double forward = direction.z;
  const double plane_t = glm::dot(normal, p0) / glm::dot(normal, direction);
  const double plane_depth = plane_t * forward;

  // The depth of the point of the triangle that the edge tests found, which is near the ray whatever the angle: in double the edge
  // functions of float corners are exact but for their last rounding.
  const DVec3 edges = edge_weights(to_double(sheared.x), to_double(sheared.y));
  const double weighted_depth = glm::dot(edges, to_double(sheared.z));
  const double sum = edges.x + edges.y + edges.z;
  const double tolerance = watertight::kDepthTolerance * largest_coordinate(p0, p1, p2);
  // Without dividing by the sum, which takes as long as all the rest.
  if (std::fabs(plane_depth * sum - weighted_depth) <= tolerance * std::fabs(sum)) return static_cast<float>(plane_t);

  const double edge_depth = weighted_depth / sum;
  // Almost edge-on: the rounding of the shear, sideways, has become a long way along the plane.
  double depth = exact_depth(direction, p0, p1, p2, tolerance);
  if (!(std::fabs(depth) < kInfinity)) {
    depth = edge_depth;
    if (plane_depth > edge_depth) depth = edge_depth + tolerance;
    if (plane_depth < edge_depth) depth = edge_depth - tolerance;
  }
  const double t = depth / forward;
  return std::fabs(t) < kInfinity ? static_cast<float>(t) : std::numeric_limits<float>::infinity();
}

}  // namespace grove
