#include "grove/accel/volume_bvh.h"

#include <gtest/gtest.h>

#include <limits>

namespace grove {
namespace {

// A root over a leaf of one reference and a leaf of two.
VolumeBvh<BoundingSphere> two_leaves() {
  VolumeBvh<BoundingSphere> bvh;
  bvh.bounds = {{0, 0, 0}, {4, 1, 1}};
  bvh.space = UnitSpace(bvh.bounds);
  bvh.nodes.push_back({{{0, 0, 0}, 1.0F}, 1, 2, 0});
  bvh.nodes.push_back({{{-0.5F, 0, 0}, 0.25F}, 0, 1, 1});
  bvh.nodes.push_back({{{0.5F, 0, 0}, 0.5F}, 1, 2, 1});
  for (const std::uint32_t id : {2U, 0U, 1U}) bvh.references.push_back(id);
  bvh.depth = 1;
  return bvh;
}

TEST(VolumeBvh, ShowsItsNodesInsideTheBounds) {
  const VolumeBvh<BoundingSphere> bvh = two_leaves();
  EXPECT_EQ(bvh.validate(3), "");
  EXPECT_EQ(bvh.memory(), 3 * 24 + 3 * 4);
  std::vector<std::uint32_t> counts;
  bvh.visit([&](const Box& box, std::uint32_t depth, std::uint32_t /*first*/, std::uint32_t count) {
    EXPECT_TRUE(bvh.bounds.contains(box));
    EXPECT_FALSE(box.is_empty());
    EXPECT_EQ(depth, count == 0 ? 0U : 1U);
    counts.push_back(count);
  });
  EXPECT_EQ(counts, (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(VolumeBvh, IsValidWhenEmpty) {
  EXPECT_EQ(VolumeBvh<OrientedBox>().validate(0), "");
  EXPECT_EQ(VolumeBvh<OrientedBox>().memory(), 0U);
}

TEST(VolumeBvhValidate, NamesWhatIsBroken) {
  EXPECT_NE(two_leaves().validate(2), "");  // reference 2 is past the primitives
  const auto problem_of = [](const auto& breaking) {
    VolumeBvh<BoundingSphere> bvh = two_leaves();
    breaking(bvh);
    return bvh.validate(3);
  };
  using Bvh = VolumeBvh<BoundingSphere>;
  EXPECT_EQ(problem_of([](Bvh&) {}), "");
  EXPECT_NE(problem_of([](Bvh& bvh) { bvh.depth = 2; }), "");
  EXPECT_NE(problem_of([](Bvh& bvh) { bvh.nodes[2].first = 0; }), "");  // reference 0 in two leaves
  EXPECT_NE(problem_of([](Bvh& bvh) { bvh.nodes[2].count = 1; }), "");  // reference 2 in none
  EXPECT_NE(problem_of([](Bvh& bvh) { bvh.nodes[2].count = 9; }), "");  // past the references
  EXPECT_NE(problem_of([](Bvh& bvh) { bvh.nodes[1].count = 0; }), "");  // an empty leaf
  EXPECT_NE(problem_of([](Bvh& bvh) { bvh.nodes[0].first = 0; }), "");  // a node that is its own child
  EXPECT_NE(problem_of([](Bvh& bvh) { bvh.nodes[0].first = 2; }), "");  // a child that is not there
  EXPECT_NE(problem_of([](Bvh& bvh) { bvh.nodes[0].count = 1; }), "");  // a single child
  EXPECT_NE(problem_of([](Bvh& bvh) { bvh.nodes[1].volume.radius = std::numeric_limits<float>::quiet_NaN(); }), "");
}

}  // namespace
}  // namespace grove
