#include "grove/lab/plane_study.h"

#include <gtest/gtest.h>

#include <array>

namespace grove {
namespace {

/// Unit cubes in a row, at these places on the x-axis.
ReferenceList cubes_at(std::initializer_list<float> places) {
  ReferenceList list;
  for (const float x : places) {
    const Box box{Vec3(x, 0.0F, 0.0F), Vec3(x + 1.0F, 1.0F, 1.0F)};
    list.references.push_back(make_reference(box, static_cast<std::uint32_t>(list.references.size())));
    list.bounds.grow(box);
  }
  return list;
}

// Half the area of a box x long is 2x + 1. Parting the cubes at 0, 1, 2 and 9 costs 3 + 3 * 19 = 60 after the first, 2 * 5 + 2 * 17 = 44 after the second and
// 3 * 7 + 3 = 24 after the third, all over 21. The spatial median is 5; the object median, 2.5, takes the second.
TEST(PlaneStudy, PartsObjectsAsByHand) {
  const PlaneTally all = study_planes(cubes_at({0.0F, 1.0F, 2.0F, 9.0F}), PartedBy::objects, 1, 3).all;
  EXPECT_EQ(all.nodes, 1U);
  EXPECT_EQ(all.axes, 1U) << "the cubes cannot be parted along the others";
  EXPECT_EQ(all.between, 1U);
  EXPECT_EQ(all.between_on_axis, 1U);
  EXPECT_EQ(all.uneven, 1U);
  EXPECT_EQ(all.crowd_is_smaller, 0U) << "three cubes in a row have more area than one";
  EXPECT_EQ(all.crowd_is_denser, 1U) << "3 objects in 7 are more than 1 in 3";
  EXPECT_DOUBLE_EQ(all.cost_between, 1.0);
  EXPECT_DOUBLE_EQ(all.cost_spatial, 1.0);
  EXPECT_DOUBLE_EQ(all.cost_object, 44.0 / 24.0);
}

// In cells the side below x has 2x + 1, the side above 2 (10 - x) + 1, cubes that are cut count on both. The best plane is at 3: 3 * 7 + 15 = 36; the spatial
// median costs 3 * 11 + 11 = 44, the object median 3 * 6 + 2 * 16 = 50.
TEST(PlaneStudy, PartsSpaceAsByHand) {
  const PlaneTally all = study_planes(cubes_at({0.0F, 1.0F, 2.0F, 9.0F}), PartedBy::space, 1, 3).all;
  EXPECT_EQ(all.nodes, 1U);
  EXPECT_EQ(all.between, 1U);
  EXPECT_EQ(all.uneven, 1U);
  EXPECT_EQ(all.crowd_is_smaller, 1U);
  EXPECT_NEAR(all.cost_between, 1.0, 1e-12);
  EXPECT_NEAR(all.cost_spatial, 44.0 / 36.0, 1e-12);
  EXPECT_NEAR(all.cost_object, 50.0 / 36.0, 1e-12);
  // The best of eight candidates is the sixth, at 5 - 2.5 * 5 / 7.
  const double x = 5.0 - 2.5 * 5.0 / 7.0;
  EXPECT_NEAR(all.cost_candidates, (3.0 * (2.0 * x + 1.0) + 2.0 * (10.0 - x) + 1.0) / 36.0, 1e-12);
}

// Four cubes in one place, 6 to 7, in a cell from 0 to 13.2: to cut off what is above costs 4 * 15, the medians 6.5 and 6.6 cut all cubes.
TEST(PlaneStudy, SeesAPlaneBeyondTheMedians) {
  ReferenceList list = cubes_at({6.0F, 6.0F, 6.0F, 6.0F});
  list.bounds.grow(Vec3(0.0F));
  list.bounds.grow(Vec3(13.2F, 1.0F, 1.0F));
  const PlaneTally all = study_planes(list, PartedBy::space, 1, 3).all;
  EXPECT_EQ(all.nodes, 1U);
  EXPECT_EQ(all.between, 0U);
  EXPECT_NEAR(all.cost_spatial, 4.0 * (2.0 * 13.2 + 1.0) / (4.0 * 15.0), 1e-6) << "parting at a median is worse than not at all";
}

TEST(PlaneStudy, GoesDownToSmallSets) {
  const ReferenceList list = cubes_at({0.0F, 1.0F, 2.0F, 3.0F, 4.0F, 5.0F, 6.0F, 7.0F});
  const PlaneStudy study = study_planes(list, PartedBy::objects, 10, 2);
  // 8 into 4 and 4 into 2 and 2.
  EXPECT_EQ(study.levels.at(0).nodes, 1U);
  EXPECT_EQ(study.levels.at(1).nodes, 2U);
  EXPECT_EQ(study.levels.at(2).nodes, 0U);
  EXPECT_EQ(study.all.nodes, 3U);
  EXPECT_EQ(study.all.uneven, 0U);
  EXPECT_EQ(study_planes(cubes_at({3.0F, 3.0F, 3.0F, 3.0F}), PartedBy::objects, 10, 2).all.nodes, 0U) << "no plane parts equal cubes";
}

}  // namespace
}  // namespace grove
