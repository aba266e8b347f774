// Both walks through a kd-tree made by hand, against clipping the ray to each cell in double; and the mailbox.

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "grove/base/random.h"
#include "grove/traverse/kd_rope_traversal.h"
#include "grove/traverse/mailbox.h"

namespace grove {
namespace {

constexpr std::uint32_t kSide = 8;

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

// The stretch of a ray inside a box, in double.
struct Stretch {
  double first, last;
};
Stretch inside(const Ray& ray, const Box& box) {
  Stretch stretch{0.0, ray.t_max};
  for (int axis = 0; axis < 3; ++axis) {
    const double d = ray.direction[axis];
    const double a = (static_cast<double>(box.lower[axis]) - ray.origin[axis]) / d;
    const double b = (static_cast<double>(box.upper[axis]) - ray.origin[axis]) / d;
    stretch.first = std::fmax(stretch.first, std::fmin(a, b));
    stretch.last = std::fmin(stretch.last, std::fmax(a, b));
  }
  return stretch;
}

// The leaves that a ray crosses for more than rounding must be visited, near to far; others only where it comes that near to them.
void expect_leaves_along(const Grid& grid, const Ray& ray, const std::vector<std::uint32_t>& visited) {
  constexpr double kRounding = 1e-4;
  double last = 0.0;
  for (const std::uint32_t leaf : visited) {
    const Stretch stretch = inside(ray, grid.cells[leaf]);
    EXPECT_GE(stretch.last - stretch.first, -kRounding);
    EXPECT_GE(stretch.first, last - kRounding);
    last = stretch.first;
  }
  for (std::uint32_t leaf = 0; leaf < grid.cells.size(); ++leaf) {
    const Stretch stretch = inside(ray, grid.cells[leaf]);
    if (stretch.last - stretch.first > kRounding) {
      EXPECT_TRUE(std::find(visited.begin(), visited.end(), leaf) != visited.end()) << leaf;
    }
  }
}

template <typename Walk>
void expect_walk_finds_leaves(const Grid& grid, const Walk& walk_leaves) {
  Random random(1);
  for (int trial = 0; trial < 500; ++trial) {
    const Vec3 from = Vec3(-0.5F) + 2.0F * Vec3(random.next_float(), random.next_float(), random.next_float());
    // To anywhere, and to corners of cells.
    Vec3 to(random.next_float(), random.next_float(), random.next_float());
    if (trial % 3 == 0) to = glm::round(to * static_cast<float>(kSide)) / static_cast<float>(kSide);
    const Ray ray{from, 0.0F, to - from, trial % 2 == 0 ? 1.0F : std::numeric_limits<float>::infinity()};
    std::vector<std::uint32_t> visited;
    walk_leaves(ray, [&](std::uint32_t first, std::uint32_t count) {
      EXPECT_EQ(count, 1U);
      visited.push_back(first);
      return false;
    });
    expect_leaves_along(grid, ray, visited);
  }
}

TEST(KdTreeWalk, VisitsTheLeavesAlongARay) {
  const Grid grid;
  ASSERT_EQ(grid.tree.validate(grid.cells.size()), "");
  NoCounter counter;
  expect_walk_finds_leaves(grid, [&](const Ray& ray, const auto& leaf) { walk(grid.tree, ray, ray.t_max, leaf, counter); });
}

TEST(KdRopeWalk, VisitsTheLeavesAlongARay) {
  const Grid grid;
  NoCounter counter;
  expect_walk_finds_leaves(grid, [&](const Ray& ray, const auto& leaf) { walk(grid.roped, grid.ropes, ray, ray.t_max, leaf, counter); });
}

// A ray in a plane, along an edge, or through a corner, touches the cells on all sides.
template <typename Walk>
void expect_all_sides(const Walk& walk_leaves) {
  const auto count_leaves = [&](const Ray& ray) {
    std::vector<std::uint32_t> visited;
    walk_leaves(ray, [&](std::uint32_t first, std::uint32_t /*count*/) {
      visited.push_back(first);
      return false;
    });
    std::sort(visited.begin(), visited.end());
    visited.erase(std::unique(visited.begin(), visited.end()), visited.end());
    return visited.size();
  };
  EXPECT_EQ(count_leaves({{0.5F, -1.0F, 0.3F}, 0.0F, {0.0F, 1.0F, 0.0F}}), 2U * kSide);
  EXPECT_EQ(count_leaves({{0.5F, -1.0F, 0.25F}, 0.0F, {-0.0F, 1.0F, 0.0F}}), 4U * kSide);
  EXPECT_EQ(count_leaves({{0.0F, 2.0F, 1.0F}, 0.0F, {0.0F, -1.0F, 0.0F}}), kSide);
  // Along the diagonal through all corners: eight cells meet at each of the seven inside.
  EXPECT_EQ(count_leaves({{-1.0F, -1.0F, -1.0F}, 0.0F, {1.0F, 1.0F, 1.0F}}), kSide + 6U * (kSide - 1));
}

TEST(KdTreeWalk, GoesToAllSidesOfPlanesEdgesAndCorners) {
  const Grid grid;
  NoCounter counter;
  expect_all_sides([&](const Ray& ray, const auto& leaf) { walk(grid.tree, ray, ray.t_max, leaf, counter); });
  expect_all_sides([&](const Ray& ray, const auto& leaf) { walk(grid.roped, grid.ropes, ray, ray.t_max, leaf, counter); });
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
