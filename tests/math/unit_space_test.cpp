#include "grove/math/unit_space.h"

#include <gtest/gtest.h>

namespace grove {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(Rounding, GoesOneWay) {
  EXPECT_EQ(round_down(0.5), 0.5F);
  EXPECT_EQ(round_up(0.5), 0.5F);
  EXPECT_EQ(round_down(1.0 + 0x1p-30), 1.0F);
  EXPECT_EQ(round_up(1.0 + 0x1p-30), 1.0F + 0x1p-23F);
  EXPECT_EQ(round_down(-1.0 - 0x1p-30), -1.0F - 0x1p-23F);
  EXPECT_EQ(round_up(-1e-60), 0.0F);
  EXPECT_EQ(round_up(1e-60), 0x1p-149F);
  EXPECT_EQ(round_up(1e60), kInfinity);
  EXPECT_EQ(round_down(1e60), std::numeric_limits<float>::max());
}

TEST(UnitSpace, BringsAnySceneToTheSizeOfOne) {
  const Box scenes[] = {{Vec3(0.0F), Vec3(1.0F)},    {Vec3(0.0F), Vec3(3e37F, 1.0F, 0.0F)},
                        {Vec3(-5e37F), Vec3(5e37F)}, {Vec3(1e6F), Vec3(1e6F + 1.0F)},
                        {Vec3(0.0F), Vec3(1e-40F)},  {Vec3(0.0F, 0.0F, 0x1p-149F), Vec3(0.0F, 0.0F, 0x1p-148F)}};
  for (const Box& scene : scenes) {
    const UnitSpace space(scene);
    const Box unit = space.to_unit(scene);
    const float longest = unit.extent()[unit.longest_axis()];
    EXPECT_GE(longest, 1.0F);
    EXPECT_LT(longest, 2.0F);
    EXPECT_NEAR(unit.centre().x, 0.0F, 1e-7F);
    EXPECT_TRUE(space.to_scene(unit).contains(scene));
    EXPECT_EQ(space.to_unit(scene.lower), -space.to_unit(scene.upper));
  }
}

TEST(UnitSpace, KeepsTheSizeOfASceneWithoutExtent) {
  const UnitSpace point(Box{Vec3(7.0F), Vec3(7.0F)});
  EXPECT_EQ(point.scale, 1.0);
  EXPECT_EQ(point.to_unit(Vec3(8.0F)), glm::dvec3(1.0));
  EXPECT_EQ(UnitSpace(Box{}).to_unit(Vec3(2.0F)), glm::dvec3(2.0));
}

}  // namespace
}  // namespace grove
