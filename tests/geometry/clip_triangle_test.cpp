#include "grove/geometry/clip_triangle.h"

#include <gtest/gtest.h>

#include "grove/base/random.h"

namespace grove {
namespace {

Vec3 random_point(Random& random, float low, float high) {
  return {random.next_float(low, high), random.next_float(low, high), random.next_float(low, high)};
}

TEST(ClipTriangle, CutsACornerOffExactly) {
  const Box clipped = clip_triangle({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {{1, 1, -1}, {9, 9, 1}});
  EXPECT_EQ(clipped.lower, Vec3(1, 1, 0));
  EXPECT_EQ(clipped.upper, Vec3(3, 3, 0));
}

TEST(ClipTriangle, IsEmptyWhereBoxesMeetButTheTriangleDoesNot) {
  EXPECT_TRUE(clip_triangle({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {{3, 3, -1}, {4, 4, 1}}).is_empty());
}

TEST(ClipTriangle, TouchesInAPoint) {
  const Box clipped = clip_triangle({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {{2, 2, 0}, {4, 4, 1}});
  EXPECT_EQ(clipped.lower, Vec3(2, 2, 0));
  EXPECT_EQ(clipped.upper, Vec3(2, 2, 0));
}

// Points of the triangle that lie in the box must lie in the clipped bounds; and the clipped bounds stay in the box and the triangle's
// own bounds.
TEST(ClipTriangle, HoldsEveryPointOfTheTriangleInTheBox) {
  Random random(3);
  for (int i = 0; i < 3000; ++i) {
    const Vec3 v[3] = {random_point(random, 0, 1), random_point(random, 0, 1), random_point(random, 0, 1)};
    Box box;
    box.grow(random_point(random, 0, 1));
    box.grow(random_point(random, 0, 1));
    const Box clipped = clip_triangle(v[0], v[1], v[2], box);
    Box whole;
    for (const Vec3& corner : v) whole.grow(corner);
    EXPECT_TRUE(box.contains(clipped));
    EXPECT_TRUE(whole.contains(clipped));
    for (int k = 0; k < 50; ++k) {
      float a = random.next_float();
      float b = random.next_float();
      if (a + b > 1.0F) {
        a = 1.0F - a;
        b = 1.0F - b;
      }
      const Vec3 p = (1.0F - a - b) * v[0] + a * v[1] + b * v[2];
      Box inside = box;  // shrunk by the rounding of p
      inside.lower += 1e-6F;
      inside.upper -= 1e-6F;
      if (!inside.contains({p, p})) continue;
      Box grown = clipped;
      grown.lower -= 1e-6F;
      grown.upper += 1e-6F;
      EXPECT_TRUE(grown.contains({p, p}));
    }
  }
}

}  // namespace
}  // namespace grove
