// The walks through an octree made by hand, against clipping the ray to each cell in double.

#include <gtest/gtest.h>

#include "grove/traverse/octree_neighbour_traversal.h"
#include "traverse/leaf_walks.h"

namespace grove {
namespace {

using testing::kSide;

// The unit cube in 8 * 8 * 8 cells; leaf i has the one reference i.
struct Grid {
  Octree tree;
  std::vector<Box> cells;

  Grid() {
    tree.bounds = tree.cell = {Vec3(0.0F), Vec3(1.0F)};
    tree.depth = 3;
    tree.nodes.resize(1);
    cut(0, tree.cell, 0);
    tree.leaf_first.push_back(static_cast<std::uint32_t>(cells.size()));
  }

 private:
  void cut(std::uint32_t number, const Box& cell, std::uint32_t depth) {
    const Vec3 middle = cell.centre();
    const bool is_last = depth + 1 == tree.depth;
    const OctreeNode node{{middle.x, middle.y, middle.z},
                          static_cast<std::uint32_t>(tree.nodes.size()),
                          static_cast<std::uint32_t>(cells.size()),
                          static_cast<std::uint8_t>(is_last ? 0 : 255),
                          static_cast<std::uint8_t>(is_last ? 255 : 0),
                          0,
                          7};
    tree.nodes[number] = node;
    if (!is_last) tree.nodes.resize(tree.nodes.size() + 8);
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
      const Box part = node.octant_cell(cell, octant);
      if (!is_last) {
        cut(node.child(octant), part, depth + 1);
        continue;
      }
      tree.leaf_first.push_back(static_cast<std::uint32_t>(cells.size()));
      tree.references.push_back(static_cast<std::uint32_t>(cells.size()));
      cells.push_back(part);
    }
  }
};

TEST(OctreeWalk, VisitsTheLeavesAlongARay) {
  const Grid grid;
  ASSERT_EQ(grid.tree.validate(grid.cells.size()), "");
  NoCounter counter;
  testing::expect_walk_finds_leaves(grid.cells, [&](const Ray& ray, const auto& leaf) { walk(grid.tree, ray, ray.t_max, leaf, counter); });
}

TEST(OctreeWalk, GoesToAllSidesOfPlanesEdgesAndCorners) {
  const Grid grid;
  NoCounter counter;
  testing::expect_all_sides([&](const Ray& ray, const auto& leaf) { walk(grid.tree, ray, ray.t_max, leaf, counter); });
}

TEST(OctreeWalk, EndsWhereNoNearerHitCanBe) {
  const Grid grid;
  TraversalCounts counts;
  Counter counter(counts);
  float t_max = std::numeric_limits<float>::infinity();
  std::uint32_t leaves = 0;
  const auto hit_in_third = [&](std::uint32_t /*first*/, std::uint32_t /*count*/) {
    if (++leaves == 3) t_max = 1.3F;
    return false;
  };
  walk(grid.tree, {{-1.0F, 0.3F, 0.3F}, 0.0F, {1.0F, 0.0F, 0.0F}}, t_max, hit_in_third, counter);
  EXPECT_EQ(leaves, 3U);
  EXPECT_EQ(counts.leaves_entered, 3U);
  EXPECT_GT(counts.stack_depth, 0U);
}

TEST(OctreeNeighbourWalk, VisitsTheLeavesAlongARay) {
  const Grid grid;
  NoCounter counter;
  testing::expect_walk_finds_leaves(
      grid.cells, [&](const Ray& ray, const auto& leaf) { walk_by_neighbours(grid.tree, ray, ray.t_max, leaf, counter); });
}

TEST(OctreeNeighbourWalk, GoesToAllSidesOfPlanesEdgesAndCorners) {
  const Grid grid;
  NoCounter counter;
  testing::expect_all_sides([&](const Ray& ray, const auto& leaf) { walk_by_neighbours(grid.tree, ray, ray.t_max, leaf, counter); });
}

// Cell by cell, each once, without falling back to the walk from the top, whose stack would be seen; from inside as well as from outside.
TEST(OctreeNeighbourWalk, NeedsNoStackWhereThereIsNoDoubt) {
  const Grid grid;
  for (const bool starts_inside : {false, true}) {
    for (const Vec3& direction : {Vec3(1.0F, 0.21F, 0.13F), Vec3(-1.0F, 0.34F, -0.27F), Vec3(0.3F, -0.4F, 0.5F)}) {
      TraversalCounts counts;
      Counter counter(counts);
      std::vector<std::uint32_t> visited;
      const auto leaf = [&](std::uint32_t first, std::uint32_t /*count*/) {
        visited.push_back(first);
        return false;
      };
      const Vec3 middle(0.51F, 0.52F, 0.53F);
      const Ray ray{starts_inside ? middle : middle - 2.0F * direction, 0.0F, direction, 10.0F};
      walk_by_neighbours(grid.tree, ray, ray.t_max, leaf, counter);
      EXPECT_EQ(counts.stack_depth, 0U);
      EXPECT_GE(visited.size(), starts_inside ? 4U : 8U);
      std::vector<std::uint32_t> sorted = visited;
      std::sort(sorted.begin(), sorted.end());
      EXPECT_EQ(std::unique(sorted.begin(), sorted.end()), sorted.end());
      // Each is beside the one before.
      for (std::size_t i = 1; i < visited.size(); ++i) {
        const Box common = grid.cells[visited[i - 1]].intersection(grid.cells[visited[i]]);
        EXPECT_FALSE(common.is_empty());
        EXPECT_GT(common.half_area(), 0.0F);
      }
    }
  }
}

TEST(OctreeNeighbourWalk, EndsWhereNoNearerHitCanBe) {
  const Grid grid;
  NoCounter counter;
  float t_max = std::numeric_limits<float>::infinity();
  std::uint32_t leaves = 0;
  const auto hit_in_third = [&](std::uint32_t /*first*/, std::uint32_t /*count*/) {
    if (++leaves == 3) t_max = 1.3F;
    return false;
  };
  walk_by_neighbours(grid.tree, {{-1.0F, 0.3F, 0.3F}, 0.0F, {1.0F, 0.0F, 0.0F}}, t_max, hit_in_third, counter);
  EXPECT_EQ(leaves, 3U);
}

// What a node keeps itself is found on the way to its octants, and ends the walk where it is hit before them.
TEST(OctreeWalk, TestsOwnReferencesBeforeOctants) {
  Octree tree;
  tree.bounds = tree.cell = {Vec3(0.0F), Vec3(1.0F)};
  tree.depth = 1;
  tree.nodes.push_back({{0.5F, 0.5F, 0.5F}, 1, 0, 0, 0b10000001, 1, 7});
  for (const std::uint32_t first : {0U, 1U, 2U, 3U}) tree.leaf_first.push_back(first);
  for (const std::uint32_t id : {0U, 1U, 2U}) tree.references.push_back(id);
  ASSERT_EQ(tree.validate(3), "");
  const Ray diagonal{Vec3(-1.0F), 0.0F, Vec3(1.0F)};
  NoCounter counter;
  for (const float hit_at : {10.0F, 1.75F, 1.25F, 0.5F}) {
    float t_max = std::numeric_limits<float>::infinity();
    std::vector<std::uint32_t> visited;
    const auto leaf = [&](std::uint32_t first, std::uint32_t /*count*/) {
      visited.push_back(first);
      t_max = hit_at;
      return false;
    };
    walk(tree, diagonal, t_max, leaf, counter);
    const std::size_t expected = hit_at > 1.5F ? 3 : hit_at > 1.0F ? 2 : 1;
    EXPECT_EQ(visited.size(), expected) << hit_at;
    EXPECT_EQ(visited[0], 0U);
  }
}

}  // namespace
}  // namespace grove
