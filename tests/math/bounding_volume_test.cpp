// Volumes whose measures are known by hand.

#include "grove/math/bounding_volume.h"

#include <gtest/gtest.h>

#include <cmath>

#include "grove/math/bounding_sphere.h"
#include "grove/math/oriented_box.h"

namespace grove {
namespace {

static_assert(BoundingVolume<OrientedBox>);
static_assert(BoundingVolume<BoundingSphere>);

// 4 by 2 by 1 around the origin, turned by 45 degrees about z.
OrientedBox turned_box() {
  const float s = std::sqrt(0.5F);
  OrientedBox box{};
  box.axes[0][0] = s;
  box.axes[1][0] = s;
  box.axes[0][1] = -s;
  box.axes[1][1] = s;
  box.axes[2][2] = 1.0F;
  const float half[3] = {2.0F, 1.0F, 0.5F};
  for (int axis = 0; axis < 3; ++axis) {
    box.lower[axis] = -half[axis];
    box.upper[axis] = half[axis];
  }
  return box;
}

TEST(OrientedBox, MeasuresByHand) {
  const OrientedBox box = turned_box();
  EXPECT_FLOAT_EQ(box.half_area(), 4 * 2 + 4 * 1 + 2 * 1);
  EXPECT_TRUE(box.contains({1.4, 1.4, 0.5}));
  EXPECT_FALSE(box.contains({1.5, 1.5, 0.0}));
  EXPECT_FALSE(box.contains({1.4, 0.0, 0.6}));
  EXPECT_TRUE(box.contains({-0.7, 0.7, 0.0}));
  EXPECT_FALSE(box.contains({-0.8, 0.8, 0.0}));
  EXPECT_FALSE(box.contains(glm::dvec3(std::nan(""))));
}

TEST(OrientedBox, LiesInsideItsBounds) {
  const Box bounds = turned_box().bounds();
  const float reach = 3.0F * std::sqrt(0.5F);  // the corner (2, 1) along its axes
  EXPECT_TRUE(bounds.contains(Box{Vec3(-reach, -reach, -0.5F), Vec3(reach, reach, 0.5F)}));
  EXPECT_NEAR(bounds.upper.x, reach, 1e-5F);
  EXPECT_NEAR(bounds.lower.z, -0.5F, 1e-5F);
}

TEST(OrientedBox, CanBeAlignedWithTheAxes) {
  const Box box{{-1, 0, 2}, {1, 0, 5}};
  const OrientedBox oriented = OrientedBox::aligned(box);
  EXPECT_EQ(oriented.half_area(), box.half_area());
  EXPECT_TRUE(oriented.contains({-1, 0, 5}));
  EXPECT_FALSE(oriented.contains({-1, 1e-30, 5}));
  EXPECT_TRUE(oriented.bounds().contains(box));
}

TEST(BoundingSphere, MeasuresByHand) {
  const BoundingSphere sphere{{1, 2, 3}, 2.0F};
  EXPECT_FLOAT_EQ(sphere.half_area(), 8.0F * kPi);
  EXPECT_TRUE(sphere.contains({1, 2, 5}));
  EXPECT_FALSE(sphere.contains({1, 2, 5.0001}));
  EXPECT_FALSE(sphere.contains(glm::dvec3(std::nan(""))));
  EXPECT_EQ(sphere.bounds().lower, Vec3(-1, 0, 1));
  EXPECT_EQ(sphere.bounds().upper, Vec3(3, 4, 5));
  const BoundingSphere point{{1, 2, 3}, 0.0F};
  EXPECT_TRUE(point.contains({1, 2, 3}));
  EXPECT_EQ(point.half_area(), 0.0F);
}

}  // namespace
}  // namespace grove
