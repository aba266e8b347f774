// Both walks through a kd-tree made by hand, against clipping the ray to each cell in double; and the mailbox.

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "grove/traverse/kd_rope_traversal.h"
#include "grove/traverse/mailbox.h"
#include "traverse/leaf_walks.h"

namespace grove {
namespace {

using testing::kSide;

// The unit cube in 8 * 8 * 8 cells, by halving x, y, z in turn; leaf i has the one reference i. Ropes are the neighbouring leaves themselves.
struct Grid {
  KdTree tree;
  KdTree roped;
  KdRopes ropes;
  std::vector<Box> cells;

  Grid() {
    tree.bounds = {Vec3(0.0F), Vec3(1.0F)};
    tree.depth = 9;
    tree.nodes.assign(2, KdNode::leaf(0, 0));
    part(0, tree.bounds, 0);
    roped = tree;
    ropes.leaves.resize(cells.size());
    std::vector<std::uint32_t> node_of(cells.size());
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i)
      if (i != 1 && tree.nodes[i].is_leaf()) node_of[tree.nodes[i].first()] = i;
    for (std::uint32_t i = 0; i < cells.size(); ++i) {
      KdRopedLeaf& leaf = ropes.leaves[i];
      leaf.cell = cells[i];
      leaf.first = i;
      leaf.count = 1;
      for (int face = 0; face < 6; ++face) {
        Vec3 behind = cells[i].centre();
        behind[face / 2] += face % 2 == 1 ? 0.125F : -0.125F;
        const auto at = std::find_if(cells.begin(), cells.end(), [&](const Box& cell) { return cell.contains(Box{behind, behind}); });
        leaf.ropes[face] = at == cells.end() ? KdRopedLeaf::kOutside : node_of[static_cast<std::size_t>(at - cells.begin())];
      }
    }
  }

 private:
  void part(std::uint32_t node, const Box& cell, std::uint32_t depth) {
    if (depth == tree.depth) {
      const auto leaf = static_cast<std::uint32_t>(cells.size());
      tree.nodes[node] = KdNode::leaf(leaf, 1);
      tree.references.push_back(leaf);
      cells.push_back(cell);
      return;
    }
    const int axis = static_cast<int>(depth % 3);
    const auto pair = static_cast<std::uint32_t>(tree.nodes.size());
    const float middle = cell.centre()[axis];
    tree.nodes.resize(pair + 2, KdNode::leaf(0, 0));
    tree.nodes[node] = KdNode::interior(axis, middle, pair);
    Box lower = cell;
    Box upper = cell;
    lower.upper[axis] = upper.lower[axis] = middle;
    part(pair, lower, depth + 1);
    part(pair + 1, upper, depth + 1);
  }
};

TEST(KdTreeWalk, VisitsTheLeavesAlongARay) {
  const Grid grid;
  ASSERT_EQ(grid.tree.validate(grid.cells.size()), "");
  NoCounter counter;
  testing::expect_walk_finds_leaves(grid.cells, [&](const Ray& ray, const auto& leaf) { walk(grid.tree, ray, ray.t_max, leaf, counter); });
}

TEST(KdRopeWalk, VisitsTheLeavesAlongARay) {
  const Grid grid;
  NoCounter counter;
  testing::expect_walk_finds_leaves(grid.cells,
                                    [&](const Ray& ray, const auto& leaf) { walk(grid.roped, grid.ropes, ray, ray.t_max, leaf, counter); });
}

TEST(KdTreeWalk, GoesToAllSidesOfPlanesEdgesAndCorners) {
  const Grid grid;
  NoCounter counter;
  testing::expect_all_sides([&](const Ray& ray, const auto& leaf) { walk(grid.tree, ray, ray.t_max, leaf, counter); });
  testing::expect_all_sides([&](const Ray& ray, const auto& leaf) { walk(grid.roped, grid.ropes, ray, ray.t_max, leaf, counter); });
}

TEST(KdTreeWalk, EndsWhereNoNearerHitCanBe) {
  const Grid grid;
  TraversalCounts counts;
  Counter counter(counts);
  float t_max = std::numeric_limits<float>::infinity();
  std::uint32_t leaves = 0;
  const auto hit_in_third = [&](std::uint32_t /*first*/, std::uint32_t /*count*/) {
    if (++leaves == 3) t_max = 1.3F;
    return false;
  };
  const Ray ray{{-1.0F, 0.3F, 0.3F}, 0.0F, {1.0F, 0.0F, 0.0F}};
  walk(grid.tree, ray, t_max, hit_in_third, counter);
  EXPECT_EQ(leaves, 3U);
  leaves = 0;
  t_max = std::numeric_limits<float>::infinity();
  walk(grid.roped, grid.ropes, ray, t_max, hit_in_third, counter);
  EXPECT_EQ(leaves, 3U);
  EXPECT_EQ(counts.leaves_entered, 6U);
  EXPECT_GT(counts.stack_depth, 0U);
}

TEST(KdRopeWalk, NeedsNoStackWhereThereIsNoDoubt) {
  const Grid grid;
  TraversalCounts counts;
  Counter counter(counts);
  const auto nothing = [](std::uint32_t /*first*/, std::uint32_t /*count*/) { return false; };
  walk(grid.roped, grid.ropes, {{-1.0F, 0.1F, 0.2F}, 0.0F, {1.0F, 0.21F, 0.13F}}, 10.0F, nothing, counter);
  EXPECT_GT(counts.leaves_entered, 8U);
  EXPECT_EQ(counts.stack_depth, 0U);
}

TEST(Mailbox, RemembersAndMayForget) {
  Mailbox mailbox;
  for (const std::uint32_t id : {0U, 5U, 15U}) {
    EXPECT_FALSE(mailbox.remembers(id));
    EXPECT_TRUE(mailbox.remembers(id));
  }
  EXPECT_FALSE(mailbox.remembers(21));
  EXPECT_TRUE(mailbox.remembers(21));
  EXPECT_TRUE(mailbox.remembers(0));
}

}  // namespace
}  // namespace grove
