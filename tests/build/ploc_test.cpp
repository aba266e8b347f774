#include "grove/build/bottom_up/ploc.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "build/boxes.h"
#include "build/sample_meshes.h"
#include "build/threads.h"
#include "grove/build/bottom_up/lbvh.h"
#include "grove/build/bottom_up/morton_order.h"
#include "grove/build/bottom_up/neighbour_search.h"
#include "grove/build/cost_model.h"
#include "grove/build/quality/preorder_nodes.h"
#include "grove/build/top_down.h"

namespace grove {
namespace {

using Ids = std::vector<std::uint32_t>;

// The sets of primitives below each node.
std::set<Ids> subsets_of(const Bvh2& bvh) {
  const PreorderNodes hierarchy(bvh, bvh.references.size());
  std::set<Ids> subsets;
  for (const PreorderNodes::Node& node : hierarchy.nodes()) {
    const auto first = bvh.references.begin() + node.first_reference;
    Ids ids(first, first + node.reference_count);
    std::sort(ids.begin(), ids.end());
    subsets.insert(std::move(ids));
  }
  return subsets;
}

struct Cluster {
  Box box;
  Ids ids;
};

// Rounds of joining as the paper has them, one thing after another, until at most `most` clusters are left.
std::vector<Cluster> agglomerate(const ReferenceList& list, std::size_t radius, std::size_t most) {
  std::vector<Cluster> clusters;
  for (const PrimitiveReference& reference : gather(list, sort_by_morton_code(list)))
    clusters.push_back({reference.box().box(), {reference.primitive()}});
  while (clusters.size() > most) {
    std::vector<Box> boxes;
    for (const Cluster& cluster : clusters) boxes.push_back(cluster.box);
    const ReferenceList places = testing::references_to(boxes);
    NeighbourSearch search(places.references, 0, AreaMeasure(list.bounds).scale());
    search.run(radius);
    std::vector<Cluster> next;
    for (std::size_t i = 0; i < clusters.size(); ++i) {
      const std::size_t partner = search.nearest(i);
      const bool is_pair = search.nearest(partner) == i;
      if (is_pair && partner < i) continue;
      next.push_back(clusters[i]);
      if (!is_pair) continue;
      next.back().box.grow(clusters[partner].box);
      next.back().ids.insert(next.back().ids.end(), clusters[partner].ids.begin(), clusters[partner].ids.end());
    }
    clusters = std::move(next);
  }
  return clusters;
}

TEST(Ploc, JoinsTheClustersThatChooseEachOther) {
  const ReferenceList list = list_references(testing::pebbles(20000, 0.03F, 1));
  for (const std::uint32_t radius : {1U, 8U, 64U}) {
    const Bvh2 bvh = build_ploc(list, {.leaf_size = 1, .radius = radius});
    ASSERT_EQ(bvh.validate(20000), "");
    const std::set<Ids> subsets = subsets_of(bvh);
    for (Cluster& cluster : agglomerate(list, radius, 1024)) {
      std::sort(cluster.ids.begin(), cluster.ids.end());
      ASSERT_TRUE(subsets.contains(cluster.ids)) << "a cluster of " << cluster.ids.size() << ", radius " << radius;
    }
  }
}

// So few are split from the top, and nothing is left to the neighbours.
TEST(Ploc, AFewAreSweptFromTheTop) {
  const ReferenceList list = list_references(testing::slivers(300, 2));
  EXPECT_EQ(subsets_of(build_ploc(list, {.leaf_size = 1})),
            subsets_of(build_top_down(list, {.split = ObjectSplit::sweep, .leaf_size = 1})));
}

TEST(Ploc, CostsLessThanTheCurveAlone) {
  const ReferenceList list = list_references(testing::slivers(30000, 3));
  EXPECT_LT(expected_cost(build_ploc(list, {}), {}), 0.9 * expected_cost(build_lbvh(list, {}), {}));
}

TEST(Ploc, KeepsEveryInvariant) {
  for (const std::size_t count : {0U, 1U, 2U, 3U, 1024U, 1025U, 30000U}) {
    for (const std::uint32_t leaf_size : {1U, 4U, 64U}) {
      for (const std::uint32_t radius : {1U, 64U}) {
        const Bvh2 bvh = build_ploc(list_references(testing::pebbles(count, 0.05F, 4)), {.leaf_size = leaf_size, .radius = radius});
        EXPECT_EQ(bvh.validate(count), "");
        EXPECT_EQ(bvh.references.size(), count);
        bvh.visit([&](const Box&, std::uint32_t, std::uint32_t, std::uint32_t references) { EXPECT_LE(references, leaf_size); });
      }
    }
  }
}

TEST(Ploc, HalvesIdenticalBoxes) {
  const Bvh2 bvh = build_ploc(testing::references_to(std::vector<Box>(65536, testing::cube(Vec3(0.5F), 0.1F))), {.leaf_size = 1});
  EXPECT_EQ(bvh.validate(65536), "");
  EXPECT_EQ(bvh.depth, 16U);
}

// Cubes around one corner that grow from one to the next: a cluster's best partner is always the next smaller one, so that each round joins
// few pairs.
TEST(Ploc, DepthIsBoundedWhereRoundsJoinLittle) {
  std::vector<Box> boxes;
  for (int i = 0; i < 5000; ++i) boxes.push_back({Vec3(0.0F), Vec3(std::exp(-0.01F * static_cast<float>(i)))});
  for (const std::uint32_t radius : {1U, 8U, 64U}) {
    const Bvh2 bvh = build_ploc(testing::references_to(boxes), {.leaf_size = 1, .radius = radius});
    EXPECT_EQ(bvh.validate(boxes.size()), "");
    EXPECT_LE(bvh.depth, Bvh2::kMaxDepth);
  }
}

TEST(Ploc, DoesNotDependOnTheThreads) {
  const ReferenceList list = list_references(testing::pebbles(50000, 0.01F, 5));
  const Bvh2 one = testing::with_threads(1, [&] { return build_ploc(list, {}); });
  for (const int threads : {2, 3, 8})
    EXPECT_TRUE(testing::same_hierarchy(one, testing::with_threads(threads, [&] { return build_ploc(list, {}); }))) << threads;
}

}  // namespace
}  // namespace grove
