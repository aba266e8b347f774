#include "grove/geometry/triangle_box_overlap.h"

#include <algorithm>
#include <cmath>

namespace grove {
namespace {

using DVec3 = glm::dvec3;

// More than the rounding of three products and their sum, relative to the largest that they can be.
constexpr double kRounding = 0x1p-49;

// Whether the cross product of an edge with a unit vector of an axis parts them: a and b are the other two axes. Both ends of the edge project to the
// same, so one of them and the third corner are enough.
bool is_apart_across(const DVec3& edge, const DVec3& on_edge, const DVec3& third, const DVec3& half, int a, int b, double slack) {
  const double p = edge[b] * on_edge[a] - edge[a] * on_edge[b];
  const double q = edge[b] * third[a] - edge[a] * third[b];
  const double reach = std::fabs(edge[b]) * half[a] + std::fabs(edge[a]) * half[b] + slack;
  return std::min(p, q) > reach || std::max(p, q) < -reach;
}

double largest(const DVec3& v) {
  return std::max(std::fabs(v.x), std::max(std::fabs(v.y), std::fabs(v.z)));
}

}  // namespace

bool overlaps_box(const Vec3& v0, const Vec3& v1, const Vec3& v2, const Box& box) {
  const DVec3 centre = 0.5 * (DVec3(box.lower) + DVec3(box.upper));
  const DVec3 half = 0.5 * (DVec3(box.upper) - DVec3(box.lower));
  const DVec3 corners[3] = {DVec3(v0) - centre, DVec3(v1) - centre, DVec3(v2) - centre};
  const double reach = std::max(largest(corners[0]), std::max(largest(corners[1]), largest(corners[2])));

  // The box's axes.
  for (int axis = 0; axis < 3; ++axis) {
    const double low = std::min(corners[0][axis], std::min(corners[1][axis], corners[2][axis]));
    const double high = std::max(corners[0][axis], std::max(corners[1][axis], corners[2][axis]));
    if (low > half[axis] + kRounding * reach || high < -half[axis] - kRounding * reach) return false;
  }
  // The triangle's plane.
  const DVec3 edges[3] = {corners[1] - corners[0], corners[2] - corners[1], corners[0] - corners[2]};
  const double longest = std::max(largest(edges[0]), std::max(largest(edges[1]), largest(edges[2])));
  const DVec3 normal = glm::cross(edges[0], edges[1]);
  const double distance = std::fabs(glm::dot(normal, corners[0]));
  if (distance > glm::dot(glm::abs(normal), half) + kRounding * longest * longest * (reach + largest(half)) * 8.0) return false;
  // Each edge with each of the box's axes.
  const double slack = kRounding * longest * (reach + largest(half));
  for (int i = 0; i < 3; ++i) {
    const DVec3& third = corners[(i + 2) % 3];
    if (is_apart_across(edges[i], corners[i], third, half, 1, 2, slack) ||
        is_apart_across(edges[i], corners[i], third, half, 2, 0, slack) || is_apart_across(edges[i], corners[i], third, half, 0, 1, slack))
      return false;
  }
  return true;
}

}  // namespace grove
