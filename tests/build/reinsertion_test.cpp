#include "grove/build/passes/reinsertion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "build/boxes.h"
#include "build/hand_made_bvh.h"
#include "build/sample_meshes.h"
#include "build/threads.h"
#include "grove/build/bottom_up/lbvh.h"
#include "grove/build/cost_model.h"
#include "grove/build/spatial_splits.h"
#include "grove/build/top_down.h"

namespace grove {
namespace {

using testing::TreeSketch;

double interior_area(const Bvh2& bvh) {
  const AreaMeasure measure(bvh.bounds);
  double sum = 0.0;
  bvh.visit([&](const Box& box, std::uint32_t /*depth*/, std::uint32_t /*first*/, std::uint32_t count) {
    sum += count == 0 ? measure.half_area(box) : 0.0;
  });
  return sum;
}

// How often each leaf is there, as its box and primitives.
std::map<std::vector<float>, int> leaves_of(const Bvh2& bvh) {
  std::map<std::vector<float>, int> leaves;
  bvh.visit([&](const Box& box, std::uint32_t /*depth*/, std::uint32_t first, std::uint32_t count) {
    if (count == 0) return;
    std::vector<float> leaf{box.lower.x, box.lower.y, box.lower.z, box.upper.x, box.upper.y, box.upper.z};
    for (std::uint32_t i = first; i < first + count; ++i) leaf.push_back(static_cast<float>(bvh.references[i]));
    ++leaves[leaf];
  });
  return leaves;
}

// Returns the share of the area of interior boxes that is left.
double expect_improved(const Bvh2& bvh, std::size_t primitive_count, const ReinsertionSettings& settings = {}) {
  const Bvh2 improved = optimize_by_reinsertion(bvh, settings);
  EXPECT_EQ(improved.validate(primitive_count), "");
  EXPECT_EQ(leaves_of(improved), leaves_of(bvh));
  const double before = interior_area(bvh);
  const double after = interior_area(improved);
  EXPECT_LE(after, before * (1.0 + 1e-6));
  return before > 0.0 ? after / before : 1.0;
}

// Leaves paired without a look at where they are.
TreeSketch paired(std::vector<TreeSketch> trees) {
  while (trees.size() > 1) {
    std::vector<TreeSketch> joined;
    for (std::size_t i = 0; i + 1 < trees.size(); i += 2) joined.emplace_back(std::move(trees[i]), std::move(trees[i + 1]));
    if (trees.size() % 2 == 1) joined.push_back(std::move(trees.back()));
    trees = std::move(joined);
  }
  return std::move(trees.front());
}

// The first leaf beside a chain of the others.
Bvh2 chain(const std::vector<Box>& boxes) {
  TreeSketch tree(boxes.back(), {static_cast<std::uint32_t>(boxes.size() - 1)});
  for (std::size_t i = boxes.size() - 1; i-- > 0;)
    tree = TreeSketch(TreeSketch(boxes[i], {static_cast<std::uint32_t>(i)}), std::move(tree));
  return testing::make_bvh(tree);
}

TEST(Reinsertion, NeverAddsAreaToAnyTree) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Random random(seed);
    const std::size_t count = 1 + random.next_u32(60);
    std::vector<TreeSketch> leaves;
    for (std::uint32_t i = 0; i < count; ++i)
      leaves.emplace_back(testing::cube(testing::random_point(random), 0.2F * random.next_float()), std::vector<std::uint32_t>{i});
    expect_improved(testing::make_bvh(paired(std::move(leaves))), count);
  }
}

TEST(Reinsertion, MendsATreeThatPairsAtRandom) {
  Random random(1);
  std::vector<TreeSketch> leaves;
  for (std::uint32_t i = 0; i < 5000; ++i)
    leaves.emplace_back(testing::cube(testing::random_point(random), 0.01F), std::vector<std::uint32_t>{i});
  EXPECT_LT(expect_improved(testing::make_bvh(paired(std::move(leaves))), 5000), 0.1);
}

TEST(Reinsertion, ImprovesWhatBuildersLeave) {
  const TriangleMesh slivers = testing::slivers(5000, 2);
  const ReferenceList list = list_references(slivers);
  EXPECT_LT(expect_improved(build_lbvh(list, {.leaf_size = 1}), 5000), 0.8);
  EXPECT_LT(expect_improved(build_top_down(list, {.split = ObjectSplit::spatial_median, .leaf_size = 1}), 5000), 0.9);
  EXPECT_LT(expect_improved(build_top_down(list, {.leaf_size = 1}), 5000), 1.0);
  EXPECT_LT(expect_improved(build_with_spatial_splits(slivers, {.leaf_size = 1}), 5000), 1.0);
}

TEST(Reinsertion, TakesWhatIsSmallOrAllTheSame) {
  for (const std::size_t count : {0U, 1U, 2U, 3U, 4U}) {
    const Bvh2 bvh = build_top_down(list_references(testing::pebbles(count, 0.1F, 3)), {.leaf_size = 1});
    expect_improved(bvh, count);
  }
  const std::vector<Box> boxes(1000, testing::cube(Vec3(0.5F), 1.0F));
  expect_improved(build_top_down(testing::references_to(boxes), {.leaf_size = 1}), boxes.size());
  const std::vector<Box> points(1000, testing::cube(Vec3(0.5F), 0.0F));
  expect_improved(build_top_down(testing::references_to(points), {.leaf_size = 1}), points.size());
}

// Deeper than any hierarchy may be. Boxes that shrink towards a corner are best left as the chain that they are; equal ones are as good in any order.
TEST(Reinsertion, BoundsTheDepthOfAChain) {
  std::vector<Box> shrinking;
  for (int i = 0; i < 300; ++i) shrinking.push_back({Vec3(0.0F), Vec3(std::pow(0.8F, static_cast<float>(i)))});
  for (const std::vector<Box>& boxes : {shrinking, std::vector<Box>(300, testing::cube(Vec3(0.5F), 1.0F))}) {
    const Bvh2 bvh = chain(boxes);
    ASSERT_EQ(bvh.depth, 299U);
    const Bvh2 improved = optimize_by_reinsertion(bvh);
    EXPECT_EQ(improved.validate(boxes.size()), "");
    EXPECT_LE(improved.depth, Bvh2::kMaxDepth);
    EXPECT_EQ(leaves_of(improved), leaves_of(bvh));
  }
}

TEST(Reinsertion, DoesNotDependOnTheThreads) {
  const Bvh2 bvh = build_lbvh(list_references(testing::pebbles(20000, 0.03F, 4)), {.leaf_size = 1});
  const Bvh2 one = testing::with_threads(1, [&] { return optimize_by_reinsertion(bvh); });
  for (const int threads : {2, 3, 8})
    EXPECT_TRUE(testing::same_hierarchy(one, testing::with_threads(threads, [&] { return optimize_by_reinsertion(bvh); }))) << threads;
}

// Four rounds over three tenths of the subtrees, of which the usual rounds try each four times.
TEST(Reinsertion, OfTheLargestGainsAGoodPart) {
  const TriangleMesh mesh = testing::slivers(3000, 12);
  const Bvh2 bvh = build_top_down(list_references(mesh), {});
  const double of_all = 1.0 - expect_improved(bvh, mesh.size());
  const double of_largest = 1.0 - expect_improved(bvh, mesh.size(), {.rounds = 4, .largest = 0.3});
  EXPECT_GT(of_all, 0.01);
  EXPECT_GT(of_largest, 0.25 * of_all);
}

}  // namespace
}  // namespace grove
