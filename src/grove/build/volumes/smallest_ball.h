#pragma once

#include "grove/math/vector.h"

namespace grove {

/// The smallest ball around a few points, found by pivoting (Gärtner, "Fast and Robust Smallest Enclosing Balls", 1999): the ball is held by up to
/// four points on its surface, and a point outside is taken in by the smallest ball that some of them and the new point hold.
/// Handing over the farthest point of a set again and again comes to the smallest ball around the set.
class SmallestBall {
 public:
  explicit SmallestBall(const glm::dvec3& point) : centre_(point), support_{point} {}

  [[nodiscard]] const glm::dvec3& centre() const { return centre_; }
  [[nodiscard]] double squared_radius() const { return squared_radius_; }

  /// Takes in a point outside. Returns whether the ball grew; where it did not, doubles cannot tell any better.
  bool take_in(const glm::dvec3& point);

 private:
  glm::dvec3 centre_;
  double squared_radius_ = 0.0;
  glm::dvec3 support_[4];
  int support_count_ = 1;
};

}  // namespace grove
