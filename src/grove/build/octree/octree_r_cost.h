#pragma once

// The cost model of octree-R (Whang et al. 1995, "Octree-R: An Adaptive Octree for Efficient Ray Tracing", as equations 5 to 9 of the review that Grove
// starts from): a ray that passes through a space R passes through a convex part of it with the ratio of their surfaces as chance.
//
//        c   ________________
//           /      /        /|      R = a * b * c, parted by a plane at t, 0 <= t <= a, into A below and B above
//          /______/________/ |
//         |  A   |   B    |  |  b
//         |______|________|/
//         0      t        a

#include <cstdint>

#include "grove/build/octree/octant_test.h"

namespace grove {

/// A space R: its side across the plane, and the two others.
struct DividedSpace {
  double a, b, c;
};

/// How many objects lie wholly below a plane, wholly above it, and on both sides: n(t), m(t) and s(t).
struct DividedCounts {
  double below, above, across;
};

/// Equation 6: the chance that a ray through R passes through A. A space without area is a line, or a point, whose lengths take the place of areas.
[[nodiscard]] inline double chance_below(const DividedSpace& space, double t) {
  const double caps = space.b * space.c;
  const double area = space.a * (space.b + space.c) + caps;
  if (area > 0.0) return (t * (space.b + space.c) + caps) / area;
  return space.a > 0.0 ? t / space.a : 1.0;
}

/// Equation 7: the same for B. The review writes P(A|R) here, too; from the text and the right-hand side it is P(B|R).
[[nodiscard]] inline double chance_above(const DividedSpace& space, double t) {
  return chance_below(space, space.a - t);
}

/// Equation 8: how many tests a ray through R is expected to make, chances given.
[[nodiscard]] inline double expected_tests(double chance_of_below, double chance_of_above, const DividedCounts& counts) {
  return chance_of_below * counts.below + chance_of_above * counts.above + (chance_of_below + chance_of_above) * counts.across;
}

/// Equation 9: equation 8 with 6 and 7 put in.
[[nodiscard]] inline double expected_tests(const DividedSpace& space, double t, const DividedCounts& counts) {
  return expected_tests(chance_below(space, t), chance_above(space, t), counts);
}

/// Equations 3 and 6 for one of the eight parts that three planes make of a cell.
[[nodiscard]] inline double chance_of_octant(const OctantCut& cut, std::uint32_t octant) {
  double whole[3];
  double part[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double lower = cut.cell.lower[axis];
    const double upper = cut.cell.upper[axis];
    const double plane = cut.planes[axis];
    whole[axis] = upper - lower;
    part[axis] = (octant >> axis & 1U) != 0 ? upper - plane : plane - lower;
  }
  const auto area = [](const double side[3]) { return side[0] * (side[1] + side[2]) + side[1] * side[2]; };
  const auto length = [](const double side[3]) { return side[0] + side[1] + side[2]; };
  if (area(whole) > 0.0) return area(part) / area(whole);
  return length(whole) > 0.0 ? length(part) / length(whole) : 1.0;
}

/// Equation 5: the time of a ray that moves on to another voxel `voxels` times and tests `tests` objects.
[[nodiscard]] inline double ray_cost(double voxels, double time_of_voxel, double tests, double time_of_test) {
  return voxels * time_of_voxel + tests * time_of_test;
}

}  // namespace grove
