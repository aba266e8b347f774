#include "grove/lab/split_costs.h"

#include <gtest/gtest.h>

namespace grove {
namespace {

// Four unit right triangles in planes of constant x = 0, 1, 2 and 4, so that the whole box is 4 by 1 by 1: half area 4 * 2 + 1 = 9.
Scene four_triangles() {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  for (const float x : {0.0F, 1.0F, 2.0F, 4.0F}) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), {{x, 0, 0}, {x, 1, 0}, {x, 0, 1}});
    triangles.emplace_back(first, first + 1, first + 2);
  }
  Scene scene;
  scene.objects.push_back({"four", std::make_shared<TriangleMesh>(std::move(vertices), std::move(triangles)), {Part{}}});
  scene.instances.push_back({"four", 0, Transform()});
  return scene;
}

TEST(SplitCosts, EqualThoseWorkedOutByHand) {
  const std::vector<SplitCostCurve> curves = split_cost_curves(four_triangles(), 3);
  ASSERT_EQ(curves.size(), 3U);
  const SplitCostCurve& x = curves[0];
  EXPECT_EQ(x.spatial_median, 2.0);
  EXPECT_EQ(x.object_median, 2.0);
  // Planes at 1, 2 and 3; what is centred in a plane lies right of it.
  ASSERT_EQ(x.planes.size(), 3U);
  const SplitCost1D& plane = x.planes[2];
  EXPECT_DOUBLE_EQ(plane.position, 3.0);
  EXPECT_EQ(plane.left, 3U);
  EXPECT_EQ(plane.right, 1U);
  // Left: x from 0 to 2, half area 2 * 2 + 1 = 5; right: a flat box, half area 1. A test costs 0.35, a step 1.
  EXPECT_NEAR(plane.standard, 1.0 + 5.0 / 9.0 * 3 * 0.35 + 1.0 / 9.0 * 0.35, 1e-6);
  // Subtrees: of three references two levels, of one reference one.
  EXPECT_NEAR(plane.equation_2, 5.0 / 9.0 * (2.0 + 3 * 0.35) + 1.0 / 9.0 * (1.0 + 0.35), 1e-6);
  // Centres on the other axes all agree.
  EXPECT_TRUE(curves[1].planes.empty());
}

TEST(SplitCosts, AreWrittenAsRows) {
  const std::string csv = split_costs_csv(split_cost_curves(four_triangles(), 1));
  EXPECT_EQ(csv.substr(0, csv.find('\n')), "axis,position,left,right,standard,equation_2,spatial_median,object_median");
  EXPECT_NE(csv.find("\nx,2,2,2,"), std::string::npos);
}

TEST(SplitCosts, OfNothingAreNone) {
  EXPECT_TRUE(split_cost_curves(Scene{}, 9).empty());
}

}  // namespace
}  // namespace grove
