#include "grove/build/volumes/smallest_ball.h"

#include <algorithm>
#include <limits>

namespace grove {
namespace {

// Points on the surface may appear outside by rounding.
constexpr double kTolerance = 1.0 + 1e-9;

double squared_distance(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::dot(a - b, a - b);
}

// The centre of the smallest ball with two, three or four points on its surface. Not finite, or far away, where the points do not span
// what they should.
glm::dvec3 circumcentre(const glm::dvec3* points, int count) {
  const glm::dvec3 a = points[1] - points[0];
  if (count == 2) return points[0] + 0.5 * a;
  const glm::dvec3 b = points[2] - points[0];
  const glm::dvec3 normal = glm::cross(a, b);
  if (count == 3) return points[0] + glm::cross(glm::dot(a, a) * b - glm::dot(b, b) * a, normal) / (2.0 * glm::dot(normal, normal));
  const glm::dvec3 c = points[3] - points[0];
  const glm::dvec3 sum = glm::dot(c, c) * normal + glm::dot(a, a) * glm::cross(b, c) + glm::dot(b, b) * glm::cross(c, a);
  return points[0] + sum / (2.0 * glm::dot(normal, c));
}

}  // namespace

bool SmallestBall::take_in(const glm::dvec3& point) {
  double least = std::numeric_limits<double>::infinity();
  glm::dvec3 centre = centre_;
  glm::dvec3 support[4];
  int support_count = 0;
  // The new point is on the surface of the new ball, with some of those that held the old one.
  for (unsigned chosen = 1; chosen < 1U << support_count_; ++chosen) {
    glm::dvec3 candidate[5] = {point};
    int count = 1;
    for (int i = 0; i < support_count_; ++i)
      if ((chosen >> i & 1U) != 0) candidate[count++] = support_[i];
    if (count > 4) continue;
    const glm::dvec3 c = circumcentre(candidate, count);
    const double squared = squared_distance(c, point);
    if (!(squared < least)) continue;
    const bool encloses = std::all_of(support_, support_ + support_count_,
                                      [&](const glm::dvec3& p) { return squared_distance(c, p) <= squared * kTolerance; });
    if (!encloses) continue;
    least = squared;
    centre = c;
    support_count = count;
    std::copy_n(candidate, count, support);
  }
  if (support_count == 0 || !(least > squared_radius_)) return false;
  centre_ = centre;
  squared_radius_ = least;
  support_count_ = support_count;
  std::copy_n(support, support_count, support_);
  return true;
}

}  // namespace grove
