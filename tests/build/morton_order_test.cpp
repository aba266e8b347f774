#include "grove/build/bottom_up/morton_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "build/boxes.h"
#include "build/sample_meshes.h"
#include "build/threads.h"
#include "grove/math/morton.h"

namespace grove {
namespace {

using testing::cube;

TEST(MortonCode, TakesTheBitsInTurn) {
  Random random(1);
  for (int run = 0; run < 1000; ++run) {
    const int bits = static_cast<int>(1 + random.next_u32(21));
    const std::uint32_t coordinates[3] = {random.next_u32(1U << bits), random.next_u32(1U << bits), random.next_u32(1U << bits)};
    std::uint64_t expected = 0;
    for (int bit = 20; bit >= 0; --bit)
      for (const std::uint32_t coordinate : coordinates) expected = expected << 1 | (coordinate >> bit & 1U);
    EXPECT_EQ(morton_code(coordinates[0], coordinates[1], coordinates[2]), expected);
  }
  EXPECT_EQ(morton_code(0x1fffff, 0x1fffff, 0x1fffff), (std::uint64_t{1} << 63) - 1);
}

// Boxes on all places of a lattice, shuffled: their order follows from their places alone.
TEST(MortonOrder, FollowsTheCurveOverALattice) {
  constexpr std::uint32_t kSide = 8;
  std::vector<std::uint32_t> places(kSide * kSide * kSide);
  std::iota(places.begin(), places.end(), 0U);
  Random random(2);
  for (std::size_t i = places.size(); i > 1; --i) std::swap(places[i - 1], places[random.next_u32(static_cast<std::uint32_t>(i))]);
  const auto code_of = [](std::uint32_t place) { return morton_code(place % kSide, place / kSide % kSide, place / kSide / kSide); };
  std::vector<Box> boxes;
  for (const std::uint32_t place : places) {
    const Vec3 centre(place % kSide, place / kSide % kSide, place / kSide / kSide);
    boxes.push_back(cube(centre * 0.1F + 3.0F, 0.25F));
  }
  const MortonOrder order = sort_by_morton_code(testing::references_to(boxes));
  ASSERT_EQ(order.indices.size(), places.size());
  for (std::size_t i = 0; i < places.size(); ++i) EXPECT_EQ(code_of(places[order.indices[i]]), i);
  EXPECT_TRUE(std::is_sorted(order.codes.begin(), order.codes.end()));
}

TEST(MortonOrder, LeavesEqualCentresInOrder) {
  std::vector<Box> boxes;
  for (int i = 0; i < 3000; ++i) boxes.push_back(cube(Vec3(static_cast<float>(i % 3)), static_cast<float>(i)));
  const MortonOrder order = sort_by_morton_code(testing::references_to(boxes));
  for (std::uint32_t i = 0; i < 3000; ++i) ASSERT_EQ(order.indices[i], i % 1000 * 3 + i / 1000);
}

TEST(MortonOrder, KeepsEveryReferenceWithItsCode) {
  for (const std::size_t count : {0U, 1U, 2U, 1000U, 70000U}) {
    const TriangleMesh mesh = testing::pebbles(count, 0.1F, 3);
    const ReferenceList list = list_references(mesh);
    const MortonOrder order = sort_by_morton_code(list);
    ASSERT_EQ(order.indices.size(), count);
    ASSERT_EQ(order.codes.size(), count);
    const HugeVector<PrimitiveReference> ordered = gather(list, order);
    ASSERT_EQ(ordered.size(), count);
    std::vector<bool> seen(count, false);
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t id = order.indices[i];
      EXPECT_FALSE(seen[id]);
      seen[id] = true;
      EXPECT_EQ(ordered[i].primitive(), list.references[id].primitive());
      EXPECT_EQ(ordered[i].box().box().lower, mesh.bounds(id).lower);
      if (i == 0) continue;
      EXPECT_LE(order.codes[i - 1], order.codes[i]);
      EXPECT_TRUE(order.codes[i - 1] < order.codes[i] || order.indices[i - 1] < id);
    }
  }
}

// A thousand boxes in one cell of the coarse grid and one far away: only the fine grid tells them apart.
TEST(MortonOrder, LooksCloserWhereCentresAreCrowded) {
  std::vector<Box> boxes;
  Random random(4);
  for (int i = 0; i < 1000; ++i) boxes.push_back(cube(3e-5F * testing::random_point(random), 1e-6F));
  boxes.push_back(cube(Vec3(1.0F), 1e-6F));
  const MortonOrder order = sort_by_morton_code(testing::references_to(boxes));
  EXPECT_EQ(order.indices.back(), 1000U);
  EXPECT_GE(order.codes.back(), std::uint64_t{7} << 60) << "not a code of 63 bits";
  // 3e-5 of 2^21 cells are 63 a side: few share one.
  std::vector<std::uint64_t> codes(order.codes.begin(), order.codes.end());
  codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
  EXPECT_GT(codes.size(), 950U);

  // Spread evenly, the coarse grid will do.
  const MortonOrder even = sort_by_morton_code(list_references(testing::pebbles(1000, 0.01F, 5)));
  EXPECT_LT(even.codes.back(), std::uint64_t{1} << 36);
}

// Many to each cell of the coarse grid, with borders of tasks between them.
TEST(MortonOrder, OfCrowdsIsThatOfFineCodes) {
  std::vector<Box> boxes;
  Random random(6);
  constexpr int kCount = 40000;
  boxes.reserve(kCount + 2);
  for (int i = 0; i < kCount; ++i) boxes.push_back(cube(4e-3F * testing::random_point(random), 1e-6F));
  boxes.push_back(cube(Vec3(1.0F), 1e-6F));
  boxes.push_back(cube(Vec3(-1.0F), 1e-6F));
  const ReferenceList list = testing::references_to(boxes);
  const MortonOrder one = testing::with_threads(1, [&] { return sort_by_morton_code(list); });
  ASSERT_GE(one.codes.back(), std::uint64_t{7} << 60) << "not a code of 63 bits";
  EXPECT_TRUE(std::is_sorted(one.codes.begin(), one.codes.end()));
  std::vector<bool> is_there(boxes.size(), false);
  for (const std::uint32_t index : one.indices) is_there[index] = true;
  EXPECT_EQ(std::count(is_there.begin(), is_there.end(), true), std::ssize(boxes));
  const MortonOrder many = testing::with_threads(3, [&] { return sort_by_morton_code(list); });
  EXPECT_EQ(many.codes, one.codes);
  EXPECT_EQ(many.indices, one.indices);
}

TEST(MortonOrder, DoesNotDependOnTheThreads) {
  const ReferenceList list = list_references(testing::pebbles(100000, 0.01F, 6));
  const MortonOrder one = testing::with_threads(1, [&] { return sort_by_morton_code(list); });
  for (const int threads : {2, 3, 8}) {
    const MortonOrder many = testing::with_threads(threads, [&] { return sort_by_morton_code(list); });
    EXPECT_EQ(many.codes, one.codes);
    EXPECT_EQ(many.indices, one.indices);
  }
}

}  // namespace
}  // namespace grove
