// Volumes fitted around sets whose best volume is known.

#include "grove/build/volumes/fit_volume.h"

#include <gtest/gtest.h>

#include <cmath>

#include "grove/base/random.h"
#include "grove/build/volumes/smallest_ball.h"

namespace grove {
namespace {

glm::dvec3 random_point(Random& random) {
  return {random.next_float(-1, 1), random.next_float(-1, 1), random.next_float(-1, 1)};
}

// Hulls of a point each, with radii where there are any.
HullList hulls_of(const std::vector<Vec3>& points, const std::vector<float>& radii = {}) {
  HullList list;
  list.points_per_hull = 1;
  list.points.assign(points.begin(), points.end());
  list.radii.assign(radii.begin(), radii.end());
  return list;
}

// Fits to points that are in unit space already.
template <typename V>
V fit(const HullList& hulls) {
  const UnitSpace space;
  const HullRange range(hulls, space, 0, hulls.points.size());
  const ExtremalPoints extremal(range);
  Box box;
  for (std::size_t i = 0; i < hulls.points.size(); ++i) {
    const Vec3 radius(hulls.radii.empty() ? 0.0F : hulls.radii[i]);
    box.grow(hulls.points[i] - radius);
    box.grow(hulls.points[i] + radius);
  }
  return fit_volume<V>({extremal, range, box});
}

TEST(SmallestBall, IsHeldByItsPoints) {
  SmallestBall ball({0, 0, 0});
  EXPECT_EQ(ball.squared_radius(), 0.0);
  EXPECT_TRUE(ball.take_in({2, 0, 0}));
  EXPECT_EQ(ball.centre(), glm::dvec3(1, 0, 0));
  EXPECT_EQ(ball.squared_radius(), 1.0);
  EXPECT_TRUE(ball.take_in({1, 2, 0}));  // acute: all three hold it
  EXPECT_NEAR(ball.squared_radius(), 1.25 * 1.25, 1e-12);
  EXPECT_TRUE(ball.take_in({1, -10, 0}));  // held by two
  EXPECT_NEAR(ball.squared_radius(), 36.0, 1e-12);
  EXPECT_FALSE(ball.take_in({1, -10, 0}));
}

TEST(SmallestBall, FindsTheBallAroundATetrahedron) {
  SmallestBall ball({1, 1, 1});
  for (const glm::dvec3& corner : {glm::dvec3(1, -1, -1), glm::dvec3(-1, 1, -1), glm::dvec3(-1, -1, 1)}) EXPECT_TRUE(ball.take_in(corner));
  EXPECT_NEAR(ball.squared_radius(), 3.0, 1e-12);
  EXPECT_NEAR(glm::length(ball.centre()), 0.0, 1e-12);
}

TEST(FitSphere, IsNearlyTheSmallest) {
  Random random(1);
  for (const std::size_t count : {2U, 3U, 10U, 1000U}) {
    std::vector<Vec3> points;
    // On the unit sphere, with two ends of a diameter: the smallest ball is known.
    for (std::size_t i = 2; i < count; ++i) points.emplace_back(glm::normalize(random_point(random)) * 0.999);
    const glm::dvec3 end = glm::normalize(random_point(random));
    points.emplace_back(end);
    points.emplace_back(-end);
    const HullList hulls = hulls_of(points);
    const auto sphere = fit<BoundingSphere>(hulls);
    EXPECT_NEAR(sphere.radius, 1.0F, 0.01F) << count;
    for (const Vec3& point : points) EXPECT_TRUE(sphere.contains(glm::dvec3(point)));
  }
}

TEST(FitSphere, EnclosesSpheresExactly) {
  const auto one = fit<BoundingSphere>(hulls_of({{0.25F, 0.5F, -0.5F}}, {0.125F}));
  EXPECT_NEAR(one.radius, 0.125F, 1e-6F);
  const auto two = fit<BoundingSphere>(hulls_of({{-0.5F, 0, 0}, {0.25F, 0, 0}}, {0.25F, 0.5F}));
  EXPECT_NEAR(two.radius, 0.75F, 1e-3F);  // from -0.75 to 0.75
  EXPECT_NEAR(two.centre.x, 0.0F, 1e-3F);
}

TEST(FitOrientedBox, FindsTheFrameOfATurnedBox) {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const glm::dvec3 u = glm::normalize(random_point(random));
    const glm::dvec3 v = glm::normalize(glm::cross(u, random_point(random)));
    const glm::dvec3 w = glm::cross(u, v);
    std::vector<Vec3> corners;
    corners.reserve(8);
    for (int corner = 0; corner < 8; ++corner)
      corners.emplace_back(u * ((corner & 1) != 0 ? 0.5 : -0.5) + v * ((corner & 2) != 0 ? 0.1 : -0.1) +
                           w * ((corner & 4) != 0 ? 0.02 : -0.02));
    const auto box = fit<OrientedBox>(hulls_of(corners));
    EXPECT_NEAR(box.half_area(), 1.0F * 0.2F + 1.0F * 0.04F + 0.2F * 0.04F, 1e-3F);
    for (const Vec3& corner : corners) EXPECT_TRUE(box.contains(glm::dvec3(corner)));
  }
}

TEST(FitOrientedBox, StaysAlignedWhereNothingIsWon) {
  const auto box = fit<OrientedBox>(hulls_of({{-0.5F, 0, 0}, {0.5F, 0, 0}, {0.5F, 0.5F, 0}, {-0.5F, 0.5F, 0}, {-0.5F, 0, 0.5F}}));
  EXPECT_EQ(box.axes[0][0], 1.0F);
  EXPECT_EQ(box.axes[1][1], 1.0F);
  EXPECT_EQ(box.axes[2][2], 1.0F);
}

TEST(FitOrientedBox, EnclosesSpheres) {
  // A string of spheres along the diagonal: the box is as long as the string and as thick as a sphere.
  std::vector<Vec3> centres;
  for (int i = -10; i <= 10; ++i) centres.emplace_back(0.05F * static_cast<float>(i));
  const auto box = fit<OrientedBox>(hulls_of(centres, std::vector<float>(centres.size(), 0.01F)));
  const float length = std::sqrt(3.0F) + 0.02F;
  EXPECT_NEAR(box.half_area(), 2.0F * length * 0.02F + 0.02F * 0.02F, 1e-3F);
}

TEST(FitVolume, TakesSetsWithoutExtent) {
  const Vec3 p(0.25F, -0.5F, 0.125F);
  const Vec3 q(-0.25F, 0.125F, 0.5F);
  for (const std::vector<Vec3>& points : {std::vector<Vec3>{p}, std::vector<Vec3>{p, p, p}, std::vector<Vec3>{p, q},
                                          std::vector<Vec3>{p, 0.5F * (p + q), q}, std::vector<Vec3>{p, q, Vec3(0.0F)}}) {
    const HullList hulls = hulls_of(points);
    const auto box = fit<OrientedBox>(hulls);
    const auto sphere = fit<BoundingSphere>(hulls);
    for (const Vec3& point : points) {
      EXPECT_TRUE(box.contains(glm::dvec3(point)));
      EXPECT_TRUE(sphere.contains(glm::dvec3(point)));
    }
    EXPECT_LT(box.half_area(), 1.0F);
    if (points.front() == points.back()) {
      EXPECT_EQ(box.half_area(), 0.0F);
      EXPECT_LT(sphere.radius, 1e-20F);
    }
  }
}

}  // namespace
}  // namespace grove
