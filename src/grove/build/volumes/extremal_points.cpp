#include "grove/build/volumes/extremal_points.h"

#include <limits>

namespace grove {
namespace {

constexpr double kDirections[7][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {1, -1, -1}};
constexpr double kDiagonalLength = 1.7320508075688772;

}  // namespace

ExtremalPoints::ExtremalPoints() {
  for (int i = 0; i < kCount; ++i) {
    reach_[i] = -std::numeric_limits<double>::infinity();
    points_[i] = glm::dvec3(0.0);
  }
}

ExtremalPoints::ExtremalPoints(const HullRange& hulls) : ExtremalPoints() {
  hulls.visit_points([this](const glm::dvec3& point, double radius) {
    for (int i = 0; i < kCount; ++i) {
      const double length = i < 6 ? 1.0 : kDiagonalLength;
      const glm::dvec3 direction =
          glm::dvec3(kDirections[i / 2][0], kDirections[i / 2][1], kDirections[i / 2][2]) * (i % 2 == 0 ? 1.0 : -1.0);
      const double reach = glm::dot(direction, point) + radius * length;
      if (!(reach > reach_[i])) continue;
      reach_[i] = reach;
      points_[i] = point + direction * (radius / length);
    }
  });
}

void ExtremalPoints::grow(const ExtremalPoints& other) {
  for (int i = 0; i < kCount; ++i) {
    if (!(other.reach_[i] > reach_[i])) continue;
    reach_[i] = other.reach_[i];
    points_[i] = other.points_[i];
  }
}

}  // namespace grove
