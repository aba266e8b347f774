#include "grove/build/bottom_up/lbvh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "build/boxes.h"
#include "build/sample_meshes.h"
#include "build/threads.h"
#include "grove/build/bottom_up/morton_order.h"
#include "grove/build/quality/preorder_nodes.h"

namespace grove {
namespace {

// How many of the sorted codes lack the highest bit in which the first and the last differ; half where all are equal.
std::uint32_t expected_left_count(const std::uint64_t* codes, std::uint32_t count) {
  const std::uint64_t different = codes[0] ^ codes[count - 1];
  if (different == 0) return count / 2;
  const int highest = 63 - std::countl_zero(different);
  return static_cast<std::uint32_t>(std::count_if(codes, codes + count, [&](std::uint64_t code) { return (code >> highest & 1U) == 0; }));
}

void expect_splits_where_codes_differ(const ReferenceList& list, std::size_t primitive_count) {
  const Bvh2 bvh = build_lbvh(list, {.leaf_size = 1});
  ASSERT_EQ(bvh.validate(primitive_count), "");
  const MortonOrder order = sort_by_morton_code(list);
  ASSERT_EQ(bvh.references.size(), order.indices.size());
  for (std::size_t i = 0; i < order.indices.size(); ++i) ASSERT_EQ(bvh.references[i], list.references[order.indices[i]].primitive());
  const PreorderNodes hierarchy(bvh, primitive_count);
  for (std::uint32_t i = 0; i < hierarchy.nodes().size(); ++i) {
    const PreorderNodes::Node& node = hierarchy.nodes()[i];
    if (hierarchy.is_leaf(i)) {
      EXPECT_EQ(node.reference_count, 1U);
    } else {
      EXPECT_EQ(hierarchy.nodes()[i + 1].reference_count,
                expected_left_count(order.codes.data() + node.first_reference, node.reference_count));
    }
  }
}

TEST(Lbvh, PartsWhereTheHighestDifferingBitChanges) {
  expect_splits_where_codes_differ(list_references(testing::pebbles(3000, 0.05F, 1)), 3000);
  expect_splits_where_codes_differ(list_references(testing::slivers(20000, 2)), 20000);
}

TEST(Lbvh, HalvesEqualCodes) {
  std::vector<Box> boxes(1000, testing::cube(Vec3(0.5F), 0.1F));
  expect_splits_where_codes_differ(testing::references_to(boxes), boxes.size());
  EXPECT_EQ(build_lbvh(testing::references_to(boxes), {.leaf_size = 1}).depth, 10U);
  // Two crowds.
  for (int i = 0; i < 500; ++i) boxes.push_back(testing::cube(Vec3(7.0F, 0.5F, 0.5F), 0.1F));
  expect_splits_where_codes_differ(testing::references_to(boxes), boxes.size());
}

TEST(Lbvh, KeepsEveryInvariant) {
  for (const std::size_t count : {0U, 1U, 2U, 3U, 100U, 30000U}) {
    for (const std::uint32_t leaf_size : {1U, 4U, 64U}) {
      const Bvh2 bvh = build_lbvh(list_references(testing::pebbles(count, 0.05F, 3)), {.leaf_size = leaf_size});
      EXPECT_EQ(bvh.validate(count), "");
      EXPECT_EQ(bvh.references.size(), count);
      bvh.visit([&](const Box&, std::uint32_t, std::uint32_t, std::uint32_t references) { EXPECT_LE(references, leaf_size); });
    }
  }
}

// Each code differs from the next in another bit, along one axis in turn, and the last of them are many times the same: as deep as it gets.
TEST(Lbvh, DepthIsBoundedForTheWorstCodes) {
  std::vector<Box> boxes{testing::cube(Vec3(1.0F), 0.0F)};
  for (int bit = 0; bit < 21; ++bit) {
    const float side = std::ldexp(1.0F, -bit);
    for (int axes = 7; axes > 0; axes /= 2)
      boxes.push_back(testing::cube(0.999F * side * Vec3(axes >> 2 & 1, axes >> 1 & 1, axes & 1), 0.0F));
  }
  for (int i = 0; i < 100000; ++i) boxes.push_back(testing::cube(Vec3(0.0F), 0.0F));
  const Bvh2 bvh = build_lbvh(testing::references_to(boxes), {.leaf_size = 1});
  EXPECT_EQ(bvh.validate(boxes.size()), "");
  EXPECT_GT(bvh.depth, 70U);
  EXPECT_LE(bvh.depth, Bvh2::kMaxDepth);
}

TEST(Lbvh, DoesNotDependOnTheThreads) {
  const ReferenceList list = list_references(testing::pebbles(100000, 0.01F, 4));
  const Bvh2 one = testing::with_threads(1, [&] { return build_lbvh(list, {}); });
  for (const int threads : {2, 3, 8})
    EXPECT_TRUE(testing::same_hierarchy(one, testing::with_threads(threads, [&] { return build_lbvh(list, {}); }))) << threads;
}

}  // namespace
}  // namespace grove
