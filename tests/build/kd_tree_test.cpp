// Kd-trees as wholes: what lies in which leaf, limits, degenerate sets, threads, ropes. Hits are checked in tests/registry.

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <map>
#include <string>

#include "build/degenerate_meshes.h"
#include "build/points_in_leaves.h"
#include "build/sample_meshes.h"
#include "build/threads.h"
#include "grove/build/kd_tree/add_ropes.h"
#include "grove/build/kd_tree/build_kd_tree.h"

namespace grove {
namespace {

constexpr KdSplit kSplits[] = {KdSplit::sah, KdSplit::binned, KdSplit::object_median, KdSplit::spatial_median};

TEST(KdTree, HasEachPointInALeafThatRefersToIt) {
  for (const KdSplit split : kSplits) {
    for (const bool clip : {true, false}) {
      for (const TriangleMesh& mesh : {testing::pebbles(3000, 0.1F, 2), testing::slivers(2000, 3)}) {
        const KdTree tree = build_kd_tree(mesh, {.split = split, .clip = clip});
        EXPECT_EQ(tree.validate(mesh.size()), "");
        EXPECT_TRUE(tree.is_compact());
        testing::expect_points_in_their_leaves(tree, mesh);
      }
    }
  }
}

TEST(KdTree, OfExactPlanesIsCheaperThanOthers) {
  const TriangleMesh mesh = testing::pebbles(5000, 0.05F, 4);
  const CostModel model = KdTreeSettings().cost;
  const double exact = expected_cost(build_kd_tree(mesh, {}), model);
  EXPECT_LE(exact, 1.02 * expected_cost(build_kd_tree(mesh, {.split = KdSplit::binned}), model));
  EXPECT_LT(exact, expected_cost(build_kd_tree(mesh, {.split = KdSplit::spatial_median}), model));
  EXPECT_LT(exact, expected_cost(build_kd_tree(mesh, {.split = KdSplit::object_median}), model));
  EXPECT_LT(exact, expected_cost(build_kd_tree(mesh, {.clip = false}), model));
  // And than no tree at all.
  EXPECT_LT(exact, 0.1 * static_cast<double>(mesh.size()));
}

TEST(KdTree, KeepsToItsLimits) {
  const TriangleMesh mesh = testing::slivers(5000, 5);
  for (const KdSplit split : kSplits) {
    for (const double most : {1.0, 1.3, 3.0}) {
      const KdTree tree = build_kd_tree(mesh, {.split = split, .most_references = most});
      EXPECT_LE(static_cast<double>(tree.references.size()), most * static_cast<double>(mesh.size()));
      EXPECT_EQ(tree.validate(mesh.size()), "");
    }
    EXPECT_LE(build_kd_tree(mesh, {.split = split, .most_depth = 5}).depth, 5U);
    EXPECT_EQ(build_kd_tree(mesh, {.split = split, .leaf_size = 5000}).nodes.size(), 2U);
  }
}

TEST(KdTree, IsWholeAndBoundedForDegenerateSets) {
  for (const auto& [name, mesh] : testing::degenerate_meshes()) {
    SCOPED_TRACE(name);
    for (const KdSplit split : kSplits) {
      for (const bool clip : {true, false}) {
        const KdTree tree = build_kd_tree(mesh, {.split = split, .clip = clip});
        ASSERT_EQ(tree.validate(mesh.size()), "");
        EXPECT_TRUE(tree.is_compact());
        EXPECT_LE(tree.depth, 28U);
        std::vector<bool> is_referenced(mesh.size(), false);
        for (const std::uint32_t id : tree.references) is_referenced[id] = true;
        std::size_t hittable = 0;
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < mesh.size(); ++i) {
          const bool can_be_hit = !mesh.bounds(i).is_empty();
          hittable += can_be_hit ? 1 : 0;
          wrong += is_referenced[i] != can_be_hit ? 1 : 0;
        }
        EXPECT_EQ(wrong, 0U) << "are left out, or in for nothing";
        EXPECT_LE(tree.references.size(), 8 * hittable);
      }
    }
  }
}

TEST(KdTree, OfNothingIsEmpty) {
  KdTree tree = build_kd_tree(TriangleMesh(), {});
  EXPECT_EQ(tree.validate(0), "");
  EXPECT_TRUE(tree.nodes.empty());
  EXPECT_TRUE(add_ropes(tree).is_empty());
}

template <typename T>
bool same_bytes(const HugeVector<T>& a, const HugeVector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

TEST(KdTree, IsTheSameForAnyNumberOfThreads) {
  // Large enough for every stage of parallel building.
  const TriangleMesh mesh = testing::pebbles(150000, 0.02F, 7);
  for (const KdSplit split : kSplits) {
    KdTree first;
    KdRopes first_ropes;
    for (const int threads : {1, 3, 8}) {
      KdRopes ropes;
      KdTree tree = testing::with_threads(threads, [&] {
        KdTree built = build_kd_tree(mesh, {.split = split});
        ropes = add_ropes(built);
        return built;
      });
      if (threads == 1) {
        first = std::move(tree);
        first_ropes = std::move(ropes);
        continue;
      }
      EXPECT_TRUE(same_bytes(tree.nodes, first.nodes)) << threads << " threads";
      EXPECT_TRUE(same_bytes(tree.references, first.references)) << threads << " threads";
      EXPECT_TRUE(same_bytes(ropes.leaves, first_ropes.leaves)) << threads << " threads";
    }
  }
}

TEST(KdRopes, LeadToTheNeighbour) {
  for (const KdSplit split : kSplits) {
    const TriangleMesh mesh = testing::pebbles(2000, 0.1F, 8);
    KdTree tree = build_kd_tree(mesh, {.split = split});
    const KdRopes ropes = add_ropes(tree);
    std::vector<Box> cells(tree.nodes.size());
    cells[0] = tree.bounds;
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
      if (i == 1 || tree.nodes[i].is_leaf()) continue;
      const int axis = static_cast<int>(tree.nodes[i].axis());
      const std::uint32_t lower = tree.nodes[i].lower_child();
      cells[lower] = cells[lower + 1] = cells[i];
      cells[lower].upper[axis] = cells[lower + 1].lower[axis] = tree.nodes[i].plane();
    }
    std::size_t wrong = 0;
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
      if (i == 1 || !tree.nodes[i].is_leaf()) continue;
      const KdRopedLeaf& leaf = ropes.leaves[tree.nodes[i].first()];
      wrong += leaf.cell.lower == cells[i].lower && leaf.cell.upper == cells[i].upper && leaf.count == tree.nodes[i].count() ? 0 : 1;
      for (int face = 0; face < 6; ++face) {
        const int axis = face / 2;
        const bool is_upper = face % 2 == 1;
        const float plane = is_upper ? leaf.cell.upper[axis] : leaf.cell.lower[axis];
        const bool is_outer = plane == (is_upper ? tree.bounds.upper[axis] : tree.bounds.lower[axis]);
        if (leaf.ropes[face] == KdRopedLeaf::kOutside) {
          wrong += is_outer ? 0 : 1;
          continue;
        }
        const Box& behind = cells[leaf.ropes[face]];
        wrong += plane == (is_upper ? behind.lower[axis] : behind.upper[axis]) ? 0 : 1;
        for (int other = 0; other < 3; ++other)
          if (other != axis)
            wrong += behind.lower[other] <= leaf.cell.lower[other] && leaf.cell.upper[other] <= behind.upper[other] ? 0 : 1;
        // No smaller node would do.
        const KdNode node = tree.nodes[leaf.ropes[face]];
        if (node.is_leaf()) continue;
        const int across = static_cast<int>(node.axis());
        wrong += across != axis && leaf.cell.lower[across] < node.plane() && node.plane() < leaf.cell.upper[across] ? 0 : 1;
      }
    }
    EXPECT_EQ(wrong, 0U);
  }
}

}  // namespace
}  // namespace grove
