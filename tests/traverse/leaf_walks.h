#pragma once

// What every walk through the cells of a grid must do, whatever structure the cells belong to. Leaf i has the one reference i.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "grove/base/random.h"
#include "grove/geometry/ray.h"
#include "grove/math/box.h"

namespace grove::testing {

/// The grids are the unit cube in so many cells along each axis.
inline constexpr std::uint32_t kSide = 8;

// The stretch of a ray inside a box, in double.
struct Stretch {
  double first, last;
};
inline Stretch inside(const Ray& ray, const Box& box) {
  Stretch stretch{0.0, ray.t_max};
  for (int axis = 0; axis < 3; ++axis) {
    const double d = ray.direction[axis];
    const double a = (static_cast<double>(box.lower[axis]) - ray.origin[axis]) / d;
    const double b = (static_cast<double>(box.upper[axis]) - ray.origin[axis]) / d;
    stretch.first = std::fmax(stretch.first, std::fmin(a, b));
    stretch.last = std::fmin(stretch.last, std::fmax(a, b));
  }
  return stretch;
}

// The leaves that a ray crosses for more than rounding must be visited, near to far; others only where it comes that near to them.
inline void expect_leaves_along(const std::vector<Box>& cells, const Ray& ray, const std::vector<std::uint32_t>& visited) {
  constexpr double kRounding = 1e-4;
  double last = 0.0;
  for (const std::uint32_t leaf : visited) {
    const Stretch stretch = inside(ray, cells[leaf]);
    EXPECT_GE(stretch.last - stretch.first, -kRounding);
    EXPECT_GE(stretch.first, last - kRounding);
    last = stretch.first;
  }
  for (std::uint32_t leaf = 0; leaf < cells.size(); ++leaf) {
    const Stretch stretch = inside(ray, cells[leaf]);
    if (stretch.last - stretch.first > kRounding) {
      EXPECT_TRUE(std::find(visited.begin(), visited.end(), leaf) != visited.end()) << leaf;
    }
  }
}

template <typename Walk>
void expect_walk_finds_leaves(const std::vector<Box>& cells, const Walk& walk_leaves) {
  Random random(1);
  for (int trial = 0; trial < 500; ++trial) {
    const Vec3 from = Vec3(-0.5F) + 2.0F * Vec3(random.next_float(), random.next_float(), random.next_float());
    // To anywhere, and to corners of cells.
    Vec3 to(random.next_float(), random.next_float(), random.next_float());
    if (trial % 3 == 0) to = glm::round(to * static_cast<float>(kSide)) / static_cast<float>(kSide);
    const Ray ray{from, 0.0F, to - from, trial % 2 == 0 ? 1.0F : std::numeric_limits<float>::infinity()};
    std::vector<std::uint32_t> visited;
    walk_leaves(ray, [&](std::uint32_t first, std::uint32_t count) {
      EXPECT_EQ(count, 1U);
      visited.push_back(first);
      return false;
    });
    expect_leaves_along(cells, ray, visited);
  }
}

// A ray in a plane, along an edge, or through a corner, touches the cells on all sides.
template <typename Walk>
void expect_all_sides(const Walk& walk_leaves) {
  const auto count_leaves = [&](const Ray& ray) {
    std::vector<std::uint32_t> visited;
    walk_leaves(ray, [&](std::uint32_t first, std::uint32_t /*count*/) {
      visited.push_back(first);
      return false;
    });
    std::sort(visited.begin(), visited.end());
    visited.erase(std::unique(visited.begin(), visited.end()), visited.end());
    return visited.size();
  };
  EXPECT_EQ(count_leaves({{0.5F, -1.0F, 0.3F}, 0.0F, {0.0F, 1.0F, 0.0F}}), 2U * kSide);
  EXPECT_EQ(count_leaves({{0.5F, -1.0F, 0.25F}, 0.0F, {-0.0F, 1.0F, 0.0F}}), 4U * kSide);
  EXPECT_EQ(count_leaves({{0.0F, 2.0F, 1.0F}, 0.0F, {0.0F, -1.0F, 0.0F}}), kSide);
  // Along the diagonal through all corners: eight cells meet at each of the seven inside.
  EXPECT_EQ(count_leaves({{-1.0F, -1.0F, -1.0F}, 0.0F, {1.0F, 1.0F, 1.0F}}), kSide + 6U * (kSide - 1));
}

}  // namespace grove::testing
