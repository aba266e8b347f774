// The top-down builder with the cost of a split as in equation 2.

#include <gtest/gtest.h>

#include <algorithm>

#include "build/boxes.h"
#include "build/sample_meshes.h"
#include "grove/build/spatial_splits.h"
#include "grove/build/top_down.h"

namespace grove {
namespace {

constexpr CostModel kStandard{.traversal = 1.0, .intersection = 0.35, .split_cost = SplitCost::standard};
constexpr CostModel kEquation2{.traversal = 1.0, .intersection = 0.35, .split_cost = SplitCost::equation_2};

// Two unit squares, `distance` apart: each has 1 / (2 distance + 1) of the area of the box around both.
Bvh2 two_squares(float distance, const CostModel& cost) {
  const std::vector<Box> boxes{{{0, 0, 0}, {0, 1, 1}}, {{distance, 0, 0}, {distance, 1, 1}}};
  return build_top_down(testing::references_to(boxes), {.leaf_size = 8, .cost = cost});
}

// Equation 2 gives a side of one reference a step and a test, and the whole no step of its own: a leaf costs 2 * 0.35, the split
// 2 * r * (1 + 0.35), which is less where the share r of the area is below 0.259. Today's form charges 1 + 2 * r * 0.35, which never is.
TEST(Equation2, DecidesLeavesAsItsFormulaSays) {
  EXPECT_EQ(two_squares(2.0F, kEquation2).nodes.size(), 1U);  // r = 0.2
  EXPECT_EQ(two_squares(1.5F, kEquation2).nodes.size(), 1U);  // r = 0.25
  EXPECT_EQ(two_squares(1.3F, kEquation2).nodes.size(), 0U);  // r = 0.278
  EXPECT_EQ(two_squares(0.5F, kEquation2).nodes.size(), 0U);
  for (const float distance : {0.5F, 2.0F, 100.0F}) EXPECT_EQ(two_squares(distance, kStandard).nodes.size(), 0U);
}

// Where to part eight squares: a gap after three of them is worth more than equal halves. Both forms agree there.
TEST(Equation2, PartsAtAGap) {
  std::vector<Box> boxes;
  for (int i = 0; i < 8; ++i)
    boxes.push_back(testing::cube(Vec3(i < 3 ? 0.1F * static_cast<float>(i) : 50.0F + 0.1F * static_cast<float>(i)), 0.05F));
  for (const CostModel& cost : {kStandard, kEquation2}) {
    const Bvh2 bvh = build_top_down(testing::references_to(boxes), {.leaf_size = 1, .cost = cost});
    ASSERT_FALSE(bvh.nodes.empty());
    EXPECT_LT(bvh.nodes[0].child_box(0).upper.x, 1.0F);
    EXPECT_GT(bvh.nodes[0].child_box(1).lower.x, 49.0F);
  }
}

TEST(Equation2, BuildsWithEverySplit) {
  const TriangleMesh mesh = testing::slivers(20000, 1);
  for (const std::uint32_t leaf_size : {1U, 8U}) {
    for (const ObjectSplit split : {ObjectSplit::binned, ObjectSplit::sweep, ObjectSplit::object_median, ObjectSplit::spatial_median}) {
      const Bvh2 bvh = build_top_down(list_references(mesh), {.split = split, .leaf_size = leaf_size, .cost = kEquation2});
      EXPECT_EQ(bvh.validate(mesh.size()), "");
      bvh.visit([&](const Box&, std::uint32_t, std::uint32_t, std::uint32_t count) { EXPECT_LE(count, leaf_size); });
    }
    EXPECT_EQ(build_with_spatial_splits(mesh, {.leaf_size = leaf_size, .cost = kEquation2}).validate(mesh.size()), "");
  }
}

}  // namespace
}  // namespace grove
