#include "grove/lab/octree_trial.h"

#include <gtest/gtest.h>

#include "grove/base/random.h"
#include "grove/lab/scattered_geometry.h"

namespace grove {
namespace {

TEST(ScatteredGeometry, IsWhatIsAskedFor) {
  for (const ScatteredPrimitive primitive : {ScatteredPrimitive::spheres, ScatteredPrimitive::triangles}) {
    const auto mean = [&](double skew) {
      const GeometryPointer geometry = scatter({primitive, 5000, skew, 3});
      return std::visit(
          [](const auto& set) {
            EXPECT_EQ(set->size(), 5000U);
            double sum = 0.0;
            for (std::size_t i = 0; i < set->size(); ++i) sum += static_cast<double>(set->bounds(i).centre().x);
            return sum / static_cast<double>(set->size());
          },
          geometry);
    };
    // The mean of u^s is 1 / (s + 1).
    EXPECT_NEAR(mean(1.0), 0.5, 0.02);
    EXPECT_NEAR(mean(3.0), 0.25, 0.02);
  }
}

TEST(ScatteredGeometry, MovesOnlySome) {
  for (const ScatteredPrimitive primitive : {ScatteredPrimitive::spheres, ScatteredPrimitive::triangles}) {
    const ScatterSettings settings{primitive, 100, 1.5, 3};
    std::vector<std::uint32_t> moved;
    const GeometryPointer before = scatter(settings);
    const GeometryPointer after = scatter_again(settings, 10, 4, moved);
    EXPECT_EQ(moved.size(), 10U);
    const auto bounds = [](const GeometryPointer& geometry, std::size_t i) {
      return std::visit([&](const auto& set) { return set->bounds(i); }, geometry);
    };
    for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(bounds(before, i).lower == bounds(after, i).lower, i % 10 != 0) << i;
    EXPECT_EQ(try_octree_update(before, after, moved, {}, 2).update_seconds.size(), 2U);
  }
}

// All ways to walk give the same hits, which try_octrees checks, and do what they must.
TEST(OctreeTrial, CountsWhatRaysDo) {
  const GeometryPointer geometry = scatter({ScatteredPrimitive::triangles, 3000, 2.0, 4});
  const std::vector<Ray> rays = rays_inside({Vec3(0.0F), Vec3(1.0F)}, 2000, 5);
  const OctreeSettings octree_r{.split = OctreeSplit::octree_r};
  const OctreeContender contenders[] = {{"octree", {}},
                                        {"neighbour", {}, OctreeWalk::neighbour},
                                        {"links", {}, OctreeWalk::neighbour, UseMailbox::yes, true},
                                        {"no mailbox", {}, OctreeWalk::top_down, UseMailbox::no},
                                        {"octree-r", octree_r},
                                        {"octree-r by links", octree_r, OctreeWalk::neighbour, UseMailbox::yes, true}};
  const std::vector<OctreeTrial> trials = try_octrees(geometry, contenders, rays, 2);
  ASSERT_EQ(trials.size(), 6U);
  for (const OctreeTrial& trial : trials) {
    EXPECT_EQ(trial.nanoseconds.size(), 2U);
    EXPECT_GT(trial.nodes_visited, 0.0);
    EXPECT_GT(trial.tests, 0.0);
  }
  EXPECT_EQ(trials[0].leaves, count_octree_leaves(geometry, {}));
  EXPECT_EQ(trials[1].leaves, trials[0].leaves);
  // Cells are come to one by one, by links or by climbing; links save steps on the way down.
  EXPECT_GT(trials[1].nodes_visited, trials[0].nodes_visited);
  EXPECT_LE(trials[2].nodes_visited, trials[1].nodes_visited);
  EXPECT_NEAR(trials[2].tests, trials[1].tests, 0.01 * trials[1].tests);
  EXPECT_GT(trials[3].tests, trials[0].tests);
  EXPECT_GT(trials[2].bytes, trials[1].bytes);
}

TEST(OctreeTrial, GivesOctreeRAsManyLeaves) {
  const GeometryPointer geometry = scatter({ScatteredPrimitive::spheres, 5000, 1.5, 6});
  const std::uint64_t leaves = count_octree_leaves(geometry, {});
  const OctreeSettings matched = match_leaves(geometry, {.split = OctreeSplit::octree_r}, leaves, 10);
  EXPECT_NEAR(static_cast<double>(count_octree_leaves(geometry, matched)), static_cast<double>(leaves), 0.1 * static_cast<double>(leaves));
}

TEST(Equation5, IsFoundFromTimesThatFollowIt) {
  Random random(7);
  std::vector<OctreeTrial> trials(9);
  for (OctreeTrial& trial : trials) {
    trial.nodes_visited = 50.0 * static_cast<double>(random.next_float());
    trial.tests = 80.0 * static_cast<double>(random.next_float());
    trial.nanoseconds = {120.0 + 31.0 * trial.nodes_visited + 7.0 * trial.tests};
  }
  const Equation5 fit = fit_equation_5(trials);
  EXPECT_NEAR(fit.per_ray, 120.0, 1e-6);
  EXPECT_NEAR(fit.per_voxel, 31.0, 1e-6);
  EXPECT_NEAR(fit.per_test, 7.0, 1e-6);
  EXPECT_NEAR(fit.r_squared, 1.0, 1e-9);
  EXPECT_NEAR(fit.predict(trials[0]), trials[0].nanoseconds[0], 1e-6);
}

}  // namespace
}  // namespace grove
