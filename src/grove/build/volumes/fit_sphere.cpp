// Spheres: the smallest ball around the extremal points (EPOS, Larsson, "Fast and Tight Fitting Bounding Spheres", 2008), then around those points
// of all primitives that are found outside, in a few rounds. Unlike in the paper, the ball takes in points by pivoting and not by
// growing only, so it comes out close to the smallest.

#include <algorithm>
#include <cmath>
#include <limits>

#include "grove/build/volumes/fit_volume.h"
#include "grove/build/volumes/smallest_ball.h"
#include "grove/math/rounding.h"

namespace grove {
namespace {

// Pivots among the extremal points, and rounds over all primitives; both mostly end sooner.
constexpr int kMaxPivots = 24;
constexpr int kMaxRounds = 3;
// A ball that is too small by less than this share is good enough.
constexpr double kPrecision = 1e-3;

SmallestBall ball_around(const ExtremalPoints& points) {
  SmallestBall ball(points[0]);
  for (int pivot = 0; pivot < kMaxPivots; ++pivot) {
    int farthest = 0;
    double most = 0.0;
    for (int i = 0; i < ExtremalPoints::kCount; ++i) {
      const glm::dvec3 from_centre = points[i] - ball.centre();
      const double squared = glm::dot(from_centre, from_centre);
      if (!(squared > most)) continue;
      most = squared;
      farthest = i;
    }
    if (most <= ball.squared_radius() * (1.0 + kPrecision) || !ball.take_in(points[farthest])) break;
  }
  return ball;
}

// A sphere's radius is a float above the distance to what it must reach, which doubles give with a relative error of less than 1e-15.
float radius_to(double distance) {
  return round_up(distance * (1.0 + 1e-12));
}

BoundingSphere sphere_around(const Box& box) {
  const Vec3 centre = box.centre();
  const glm::dvec3 reach = glm::max(glm::dvec3(box.upper) - glm::dvec3(centre), glm::dvec3(centre) - glm::dvec3(box.lower));
  return {centre, radius_to(glm::length(reach))};
}

}  // namespace

template <>
BoundingSphere fit_volume<BoundingSphere>(const FitTask& task) {
  BoundingSphere best = sphere_around(task.box);
  SmallestBall ball = ball_around(task.extremal);
  for (int round = 0; round < kMaxRounds; ++round) {
    // Inside the box it is no farther from a ray's origin than the scene reaches, which the test of a ray relies on.
    const Vec3 centre = glm::clamp(Vec3(ball.centre()), task.box.lower, task.box.upper);
    const HullRange::Farthest farthest = task.hulls.farthest_from(centre);
    const float radius = radius_to(farthest.distance);
    if (radius < best.radius) best = {centre, radius};
    if (farthest.distance <= std::sqrt(ball.squared_radius()) * (1.0 + kPrecision) || !ball.take_in(farthest.point)) break;
  }
  return best;
}

}  // namespace grove
