#include "grove/lab/chance_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "build/hand_made_bvh.h"
#include "grove/lab/scattered_geometry.h"
#include "grove/registry/registry.h"

namespace grove::testing {
namespace {

const Box kLower{Vec3(0.0F), Vec3(1.0F, 1.0F, 1.0F)};
const Box kUpper{Vec3(2.0F, 0.0F, 0.0F), Vec3(4.0F, 1.0F, 1.0F)};

// Half areas: 3 and 5 in a box of 4 x 1 x 1 with 9.
TEST(ChanceStudy, FindsTheRatioOfAreasByUniformLines) {
  const Bvh2 tree = make_bvh(TreeSketch(TreeSketch(kLower, {0}), TreeSketch(kUpper, {1})));
  const std::vector<Ray> lines = lines_through({Vec3(-1.0F), Vec3(5.0F, 2.0F, 2.0F)}, 200'000, 4);
  const ChanceStudy study = study_chances(tree, lines, nullptr);
  ASSERT_EQ(study.pairs.size(), 2U);
  EXPECT_DOUBLE_EQ(study.pairs[0].expected, 3.0 / 9.0);
  EXPECT_DOUBLE_EQ(study.pairs[1].expected, 5.0 / 9.0);
  for (const ChancePair& pair : study.pairs) {
    EXPECT_GT(pair.parent_rays, 10'000U);
    // Five standard deviations of a share.
    EXPECT_NEAR(pair.measured, pair.expected, 5.0 * 0.5 / std::sqrt(static_cast<double>(pair.parent_rays)));
  }
  EXPECT_NEAR(study.mean_ratio, 1.0, 0.02);
  EXPECT_LT(study.departure, 4.0 * study.noise);
}

// All rays along the row pass through both boxes.
TEST(ChanceStudy, SeesRaysThatAreNotUniform) {
  const Bvh2 tree = make_bvh(TreeSketch(TreeSketch(kLower, {0}), TreeSketch(kUpper, {1})));
  const std::vector<Ray> rays(1000, Ray{Vec3(-1.0F, 0.5F, 0.5F), 0.0F, Vec3(1.0F, 0.0F, 0.0F), 100.0F});
  const ChanceStudy study = study_chances(tree, rays, nullptr);
  ASSERT_EQ(study.pairs.size(), 2U);
  for (const ChancePair& pair : study.pairs) EXPECT_EQ(pair.measured, 1.0);
  EXPECT_GT(study.departure, 0.5);
  EXPECT_TRUE(study_chances(tree, std::span(rays).first(100), nullptr).pairs.empty()) << "too few rays say nothing";
}

// A hundred small boxes on one side of a cube, none on the other.
TEST(ExpectedTests, AreWhatUniformLinesTest) {
  ReferenceList list;
  for (std::uint32_t i = 0; i < 100; ++i) {
    const Vec3 corner(0.3F * static_cast<float>(i % 5) / 5.0F, static_cast<float>(i % 10) / 10.0F, static_cast<float>(i) / 110.0F);
    list.references.push_back(make_reference({corner, corner + 0.05F}, i));
  }
  list.bounds = {Vec3(0.0F), Vec3(1.0F)};
  const std::vector<PlaneTests> planes = study_expected_tests(list, 0, 3, lines_through(list.bounds, 200'000, 9), nullptr);
  ASSERT_EQ(planes.size(), 3U);
  for (const PlaneTests& plane : planes) {
    EXPECT_GT(plane.expected, 0.0);
    EXPECT_NEAR(plane.measured / plane.expected, 1.0, 0.02) << plane.position;
  }
  // All objects are below 0.5: only rays that pass through the lower half test them.
  EXPECT_DOUBLE_EQ(planes[1].position, 0.5);
  EXPECT_NEAR(planes[1].expected, 100.0 * (0.5 * 2.0 + 1.0) / 3.0, 1e-4);
}

TEST(LinesThrough, MeetTheBoxFromOutside) {
  const Box box{Vec3(-1.0F, 0.0F, 2.0F), Vec3(1.0F, 3.0F, 2.5F)};
  double inside = 0.0;
  const std::vector<Ray> lines = lines_through(box, 20'000, 5);
  for (const Ray& line : lines) {
    EXPECT_FALSE(box.contains({line.origin, line.origin}));
    double first = 0.0;
    double last = 1e30;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = (static_cast<double>(box.lower[axis]) - line.origin[axis]) / line.direction[axis];
      const double b = (static_cast<double>(box.upper[axis]) - line.origin[axis]) / line.direction[axis];
      first = std::max(first, std::min(a, b));
      last = std::min(last, std::max(a, b));
    }
    EXPECT_LT(first, last + 1e-5);
    inside += std::max(0.0, last - first) * static_cast<double>(glm::length(line.direction));
  }
  // The mean chord of a convex body is four times its volume over its area.
  const double volume = 2.0 * 3.0 * 0.5;
  const double area = 2.0 * (2.0 * 3.0 + 3.0 * 0.5 + 2.0 * 0.5);
  EXPECT_NEAR(inside / 20'000.0, 4.0 * volume / area, 0.02);
}

}  // namespace
}  // namespace grove::testing
