#include "grove/build/passes/collapse.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "build/exhaustive_collapse.h"
#include "build/hand_made_bvh.h"
#include "build/sample_meshes.h"
#include "grove/build/spatial_splits.h"
#include "grove/build/top_down.h"

namespace grove {
namespace {

using testing::TreeSketch;

// A binary hierarchy of any shape over `count` leaves of one or two references.
TreeSketch random_tree(std::size_t count, std::uint32_t& next_id, Random& random) {
  if (count == 1) {
    Box box;
    box.grow(testing::random_point(random));
    box.grow(box.lower + 0.4F * testing::random_point(random));
    std::vector<std::uint32_t> ids{next_id++};
    if (random.next_u32(4) == 0) ids.push_back(next_id++);
    return {box, ids};
  }
  const std::size_t left_count = 1 + random.next_u32(static_cast<std::uint32_t>(count - 1));
  TreeSketch left = random_tree(left_count, next_id, random);
  return {std::move(left), random_tree(count - left_count, next_id, random)};
}

Bvh2 random_bvh(std::size_t leaf_count, std::uint64_t seed) {
  Random random(seed);
  std::uint32_t id_count = 0;
  return testing::make_bvh(random_tree(leaf_count, id_count, random));
}

// What the plan comes to, walked from its root.
double plan_cost(const CollapsePlan& plan, const SlotAreas& areas, const CollapsePlan::Child& child, const CostModel& model) {
  const double area = child.slot == CollapsePlan::kRootSlot ? areas.root : areas.slots[child.slot];
  if (child.count > 0) return model.intersection * child.count * area;
  CollapsePlan::Child children[CollapsePlan::kMaxArity];
  const int count = plan.children(child.node, children);
  double cost = model.traversal * area;
  for (int i = 0; i < count; ++i) cost += plan_cost(plan, areas, children[i], model);
  return cost;
}

double plan_cost(const Bvh2& bvh, const CollapseSettings& settings) {
  const SlotAreas areas = box_areas(bvh);
  const CollapsePlan plan(bvh, areas.slots, areas.root, settings);
  return plan_cost(plan, areas, plan.root(), settings.cost) / static_cast<double>(areas.root);
}

double collapsed_cost(const Bvh2& bvh, const CollapseSettings& settings) {
  if (settings.arity == 2) return expected_cost(collapse_leaves(bvh, settings), settings.cost);
  if (settings.arity == 4) return expected_cost(widen<4>(bvh, settings), settings.cost);
  return expected_cost(widen<8>(bvh, settings), settings.cost);
}

// Calls check(hierarchy) for what a binary hierarchy collapses to at each arity.
template <typename Check>
void for_each_collapse(const Bvh2& bvh, CollapseSettings settings, const Check& check) {
  for (const Widening widening : {Widening::optimal, Widening::greedy}) {
    settings.widening = widening;
    check(widen<4>(bvh, settings));
    check(widen<8>(bvh, settings));
  }
  check(collapse_leaves(bvh, settings));
}

TEST(Collapse, OptimalPlanCostsAsLittleAsAnyCollapse) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Bvh2 bvh = random_bvh(2 + seed % 8, seed);
    for (const int arity : {2, 4, 8}) {
      for (const double intersection : {0.1, 0.35, 2.0}) {
        const CollapseSettings settings{.arity = arity, .leaf_size = 3, .cost = {.intersection = intersection}};
        const double least = testing::ExhaustiveCollapse(bvh, settings).least_cost();
        EXPECT_NEAR(collapsed_cost(bvh, settings), least, 1e-5 * least) << "seed " << seed << ", arity " << arity;
      }
    }
  }
}

TEST(Collapse, CostsWhatThePlanSaysAndNoMoreThanGreedily) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Bvh2 bvh = random_bvh(300, seed);
    for (const int arity : {2, 4, 8}) {
      CollapseSettings settings{.arity = arity};
      const double optimal = collapsed_cost(bvh, settings);
      EXPECT_NEAR(optimal, plan_cost(bvh, settings), 1e-5 * optimal);
      if (arity == 2) continue;
      settings.widening = Widening::greedy;
      const double greedy = collapsed_cost(bvh, settings);
      EXPECT_NEAR(greedy, plan_cost(bvh, settings), 1e-5 * greedy);
      EXPECT_LE(optimal, greedy * (1.0 + 1e-5));
    }
  }
}

TEST(Collapse, NeverCostsMoreThanWhatItStartsFrom) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Bvh2 bvh = random_bvh(300, seed);
    const double before = expected_cost(bvh, {});
    EXPECT_LE(collapsed_cost(bvh, {.arity = 2}), before * (1.0 + 1e-5));
    EXPECT_LE(collapsed_cost(bvh, {.arity = 8}), before * (1.0 + 1e-5));
  }
}

TEST(Collapse, KeepsEveryInvariant) {
  for (const std::size_t count : {0U, 1U, 2U, 3U, 1000U, 40000U}) {
    const Bvh2 bvh = build_top_down(list_references(testing::pebbles(count, 0.05F, 1)), {.leaf_size = 1});
    for (const std::uint32_t leaf_size : {1U, 5U, 64U}) {
      for_each_collapse(bvh, {.leaf_size = leaf_size}, [&](const auto& collapsed) {
        EXPECT_EQ(collapsed.validate(count), "") << count;
        EXPECT_EQ(collapsed.references.size(), count);
        collapsed.visit([&](const Box&, std::uint32_t, std::uint32_t, std::uint32_t references) { EXPECT_LE(references, leaf_size); });
      });
    }
  }
}

// Pieces of one primitive that come together in a leaf are one reference again.
TEST(Collapse, LeavesNameNoPrimitiveTwice) {
  const TriangleMesh mesh = testing::slivers(2000, 2);
  const Bvh2 bvh = build_with_spatial_splits(mesh, {.leaf_size = 1});
  ASSERT_GT(bvh.references.size(), mesh.size());
  for_each_collapse(bvh, {.leaf_size = 64, .cost = {.intersection = 0.05}}, [&](const auto& collapsed) {
    EXPECT_EQ(collapsed.validate(mesh.size()), "");
    EXPECT_LT(collapsed.references.size(), bvh.references.size());
    std::set<std::uint32_t> all;
    collapsed.visit([&](const Box& /*box*/, std::uint32_t /*depth*/, std::uint32_t first, std::uint32_t count) {
      const std::set<std::uint32_t> leaf(collapsed.references.begin() + first, collapsed.references.begin() + first + count);
      EXPECT_EQ(leaf.size(), count);
      all.insert(leaf.begin(), leaf.end());
    });
    EXPECT_EQ(all.size(), mesh.size());
  });
}

}  // namespace
}  // namespace grove
