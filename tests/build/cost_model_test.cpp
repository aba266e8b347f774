#include "grove/build/cost_model.h"

#include <gtest/gtest.h>

#include "grove/accel/bvh2.h"

namespace grove {
namespace {

Bvh2 two_leaves() {
  Bvh2 bvh;
  bvh.bounds = {{0, 0, 0}, {4, 1, 1}};
  Bvh2Node node{};
  const Box boxes[2] = {{{0, 0, 0}, {1, 1, 1}}, {{3, 0, 0}, {4, 1, 1}}};
  for (int child = 0; child < 2; ++child) {
    for (int axis = 0; axis < 3; ++axis) {
      node.planes[axis][child] = boxes[child].lower[axis];
      node.planes[axis][child + 2] = boxes[child].upper[axis];
    }
  }
  node.child[0] = {0, 2};
  node.child[1] = {2, 1};
  bvh.nodes.push_back(node);
  for (const std::uint32_t id : {0U, 1U, 2U}) bvh.references.push_back(id);
  bvh.depth = 1;
  return bvh;
}

TEST(CostModel, MatchesTheSumByHand) {
  const Bvh2 bvh = two_leaves();
  EXPECT_EQ(bvh.validate(3), "");
  // Areas: root 2 * (4 + 4 + 1) = 18, each child 6.
  EXPECT_DOUBLE_EQ(expected_cost(bvh, {.traversal = 1.5, .intersection = 2.0}), 1.5 + 6.0 / 18.0 * 2.0 * 2 + 6.0 / 18.0 * 2.0 * 1);
  EXPECT_EQ(expected_cost(Bvh2{}, {}), 0.0);
}

TEST(CostModel, AreasNeitherOverflowNorVanish) {
  for (const float scale : {1e-40F, 1e-20F, 1.0F, 1e18F, 3e37F}) {
    const Box box{Vec3(0.0F), Vec3(scale)};
    const Box half{Vec3(0.0F), Vec3(scale * 0.5F)};
    const AreaMeasure measure(box);
    EXPECT_NEAR(measure.half_area(half) / measure.half_area(box), 0.25, 1e-4) << scale;
  }
}

TEST(Bvh2Validate, NamesWhatIsBroken) {
  Bvh2 bvh = two_leaves();
  EXPECT_NE(bvh.validate(2), "");  // reference 2 is past the primitives
  bvh.depth = 2;
  EXPECT_NE(bvh.validate(3), "");
  bvh = two_leaves();
  bvh.nodes[0].child[1] = {1, 1};
  EXPECT_NE(bvh.validate(3), "");  // reference 1 in two leaves
  bvh = two_leaves();
  bvh.nodes[0].planes[1][3] = 2.0F;
  EXPECT_NE(bvh.validate(3), "");  // a child larger than its parent
  bvh = two_leaves();
  bvh.nodes[0].child[0] = {0, 0};
  EXPECT_NE(bvh.validate(3), "");  // a node that is its own child
}

}  // namespace
}  // namespace grove
