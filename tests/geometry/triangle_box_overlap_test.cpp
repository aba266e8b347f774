#include "grove/geometry/triangle_box_overlap.h"

#include <gtest/gtest.h>

#include "grove/base/random.h"
#include "grove/geometry/clip_triangle.h"
#include "grove/geometry/sphere_set.h"
#include "grove/geometry/triangle_mesh.h"

namespace grove {
namespace {

Vec3 random_point(Random& random) {
  return {random.next_float(), random.next_float(), random.next_float()};
}

TEST(TriangleBoxOverlap, IsExactWhereBoxesMeetButTheTriangleDoesNot) {
  const Vec3 v[] = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  EXPECT_FALSE(overlaps_box(v[0], v[1], v[2], {{3, 3, -1}, {4, 4, 1}}));
  EXPECT_FALSE(overlaps_box(v[0], v[1], v[2], {{2.001F, 2, -1}, {4, 4, 1}}));
  EXPECT_FALSE(overlaps_box(v[0], v[1], v[2], {{1, 1, 0.001F}, {2, 2, 1}}));
  EXPECT_TRUE(overlaps_box(v[0], v[1], v[2], {{1.5F, 1.5F, -1}, {4, 4, 1}}));
}

TEST(TriangleBoxOverlap, CountsTouching) {
  const Vec3 v[] = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  EXPECT_TRUE(overlaps_box(v[0], v[1], v[2], {{2, 2, 0}, {4, 4, 1}}));     // in a corner of the box
  EXPECT_TRUE(overlaps_box(v[0], v[1], v[2], {{4, -1, -1}, {5, 1, 1}}));   // in a corner of the triangle
  EXPECT_TRUE(overlaps_box(v[0], v[1], v[2], {{0, 0, -1}, {1, 1, 0}}));    // in its plane
  EXPECT_TRUE(overlaps_box(v[0], v[1], v[2], {{-1, -1, -1}, {9, 9, 1}}));  // all of it
  EXPECT_TRUE(overlaps_box(v[0], v[1], v[2], {{1, 1, -1}, {1, 1, 1}}));    // a box without volume
}

TEST(TriangleBoxOverlap, WorksForPointsAndLines) {
  const Box box{{0, 0, 0}, {1, 1, 1}};
  EXPECT_TRUE(overlaps_box({0.5F, 0.5F, 0.5F}, {0.5F, 0.5F, 0.5F}, {0.5F, 0.5F, 0.5F}, box));
  EXPECT_FALSE(overlaps_box({1.5F, 0.5F, 0.5F}, {1.5F, 0.5F, 0.5F}, {1.5F, 0.5F, 0.5F}, box));
  EXPECT_TRUE(overlaps_box({-1, 0.5F, 0.5F}, {2, 0.5F, 0.5F}, {2, 0.5F, 0.5F}, box));
  EXPECT_FALSE(overlaps_box({-1, 1, 0.5F}, {0.9F, 3, 0.5F}, {0.9F, 3, 0.5F}, box));
}

// Cutting the triangle out of the box is another way to find out. On random floats the two must agree; on a lattice, where touching is the rule, what
// the cut finds must not be missed.
TEST(TriangleBoxOverlap, AgreesWithClipping) {
  Random random(5);
  int overlaps = 0;
  for (int i = 0; i < 200000; ++i) {
    const bool is_lattice = i % 2 == 0;
    const float scale = i % 3 == 0 ? 0.3F : 1.0F;
    const auto point = [&] { return is_lattice ? glm::floor(5.0F * random_point(random)) : scale * random_point(random); };
    const Vec3 v[3] = {point(), point(), point()};
    Box box;
    box.grow(point());
    box.grow(point());
    const bool is_cut = !clip_triangle(v[0], v[1], v[2], box).is_empty();
    const bool is_overlapping = overlaps_box(v[0], v[1], v[2], box);
    overlaps += is_overlapping ? 1 : 0;
    if (is_lattice) {
      EXPECT_TRUE(is_overlapping || !is_cut);
    } else {
      EXPECT_EQ(is_overlapping, is_cut);
    }
  }
  EXPECT_GT(overlaps, 50000);
  EXPECT_LT(overlaps, 150000);
}

TEST(TriangleBoxOverlap, HoldsAtExtremeScales) {
  Random random(6);
  for (const float scale : {1e-40F, 1e-20F, 1e18F, 4e37F}) {
    for (int i = 0; i < 2000; ++i) {
      const Vec3 v[3] = {random_point(random), random_point(random), random_point(random)};
      const Vec3 inside = (v[0] + v[1] + v[2]) / 3.0F;
      const Box box{inside - Vec3(0.01F), inside + Vec3(0.01F)};
      EXPECT_TRUE(overlaps_box(scale * v[0], scale * v[1], scale * v[2], {scale * box.lower, scale * box.upper}));
    }
  }
}

TEST(Overlap, OfAMeshIsFalseForWhatIsNeverHit) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {nan, 0, 0}}, {{0, 1, 2}, {0, 1, 3}});
  const Box box{Vec3(-1.0F), Vec3(1.0F)};
  EXPECT_TRUE(mesh.overlaps(0, box));
  EXPECT_FALSE(mesh.overlaps(1, box));
}

TEST(Overlap, OfASphereIsThatOfItsSurface) {
  const SphereSet set(std::vector<SphereSet::Sphere>{{Vec3(0.0F), 1.0F}});
  EXPECT_TRUE(set.overlaps(0, {{0.5F, 0.5F, 0.5F}, {1, 1, 1}}));
  EXPECT_FALSE(set.overlaps(0, {{0.8F, 0.8F, 0.8F}, {1, 1, 1}}));      // boxes meet, but not the ball
  EXPECT_FALSE(set.overlaps(0, {{-0.5F, -0.5F, -0.5F}, Vec3(0.5F)}));  // inside
  EXPECT_TRUE(set.overlaps(0, {{1, -1, -1}, {2, 1, 1}}));              // touching
}

}  // namespace
}  // namespace grove
