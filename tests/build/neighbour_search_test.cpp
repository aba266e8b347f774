#include "grove/build/bottom_up/neighbour_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "build/boxes.h"
#include "build/sample_meshes.h"
#include "grove/build/cost_model.h"

namespace grove {
namespace {

float joint_half_area(const Box& a, const Box& b) {
  Box joint = a;
  joint.grow(b);
  return joint.half_area();
}

// The place in the one order of pairs: area, distance, first place (of next-door neighbours even places first).
using PairKey = std::tuple<float, std::size_t, bool, std::size_t>;

std::size_t brute_nearest(const std::vector<Box>& boxes, std::size_t first_place, std::size_t i, std::size_t radius) {
  PairKey best{std::numeric_limits<float>::infinity(), 0, false, 0};
  std::size_t nearest = i;
  for (std::size_t other = i > radius ? i - radius : 0; other < std::min(boxes.size(), i + radius + 1); ++other) {
    if (other == i) continue;
    const std::size_t first = std::min(i, other);
    const std::size_t distance = std::max(i, other) - first;
    const PairKey key{joint_half_area(boxes[i], boxes[other]), distance, distance == 1 && (first_place + first) % 2 == 1, first};
    if (key < best) {
      best = key;
      nearest = other;
    }
  }
  return nearest;
}

// Boxes on whole coordinates: areas are small whole numbers, exact and often equal.
std::vector<Box> lattice_boxes(std::size_t count, std::uint32_t side, std::uint64_t seed) {
  Random random(seed);
  const auto coordinate = [&] { return static_cast<float>(random.next_u32(side)); };
  std::vector<Box> boxes(count);
  for (Box& box : boxes) {
    for (int corner = 0; corner < 2; ++corner) {
      const float x = coordinate();
      const float y = coordinate();
      box.grow(Vec3(x, y, coordinate()));
    }
  }
  return boxes;
}

TEST(NeighbourSearch, FindsWhatTryingAllFindsAlsoAmongEquals) {
  for (const std::size_t count : {2U, 3U, 5U, 8U, 9U, 100U}) {
    for (const std::uint32_t side : {1U, 2U, 4U, 16U}) {
      const std::vector<Box> boxes = lattice_boxes(count, side, count + side);
      const ReferenceList list = testing::references_to(boxes);
      for (const std::size_t first_place : {0U, 1U}) {
        for (const std::size_t radius : {1U, 2U, 3U, 8U, 16U, 64U}) {
          NeighbourSearch search(list.references, first_place, 1.0F / 32.0F);
          search.run(radius);
          for (std::size_t i = 0; i < count; ++i)
            ASSERT_EQ(search.nearest(i), brute_nearest(boxes, first_place, i, radius))
                << count << " boxes of side " << side << " from place " << first_place << ", radius " << radius << ", box " << i;
        }
      }
    }
  }
}

// Areas are compared without their last bits.
TEST(NeighbourSearch, FindsTheLeastAreaOfAnyBoxesButForTheLastBits) {
  const TriangleMesh mesh = testing::pebbles(500, 0.2F, 3);
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < mesh.size(); ++i) boxes.push_back(mesh.bounds(i));
  const ReferenceList list = testing::references_to(boxes);
  for (const std::size_t radius : {1U, 8U, 64U}) {
    NeighbourSearch search(list.references, 0, AreaMeasure(list.bounds).scale());
    search.run(radius);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const std::size_t found = search.nearest(i);
      ASSERT_LT(found, boxes.size());
      ASSERT_NE(found, i);
      EXPECT_LE(found > i ? found - i : i - found, radius);
      const float least = joint_half_area(boxes[i], boxes[brute_nearest(boxes, 0, i, radius)]);
      EXPECT_LE(joint_half_area(boxes[i], boxes[found]), least * (1.0F + 1e-4F));
    }
  }
}

// Boxes whose neighbours all lie in a stretch have the same neighbours as in the whole.
TEST(NeighbourSearch, StretchesAgreeWithTheWhole) {
  const std::vector<Box> boxes = lattice_boxes(200, 6, 4);
  const ReferenceList list = testing::references_to(boxes);
  constexpr std::size_t kRadius = 8;
  NeighbourSearch whole(list.references, 0, 1.0F / 32.0F);
  whole.run(kRadius);
  for (const std::size_t first : {37U, 64U}) {
    NeighbourSearch stretch({list.references.data() + first, 100}, first, 1.0F / 32.0F);
    stretch.run(kRadius);
    for (std::size_t i = kRadius; i < 100 - kRadius; ++i) EXPECT_EQ(first + stretch.nearest(i), whole.nearest(first + i));
  }
}

// The first of all pairs is chosen from both sides, so that every round joins at least one.
TEST(NeighbourSearch, SomePairChoosesEachOther) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const std::vector<Box> boxes = lattice_boxes(20, 3, seed);
    const ReferenceList list = testing::references_to(boxes);
    NeighbourSearch search(list.references, seed % 2, 1.0F / 32.0F);
    search.run(4);
    bool found = false;
    for (std::size_t i = 0; i < boxes.size(); ++i) found = found || search.nearest(search.nearest(i)) == i;
    EXPECT_TRUE(found) << seed;
  }
}

}  // namespace
}  // namespace grove
