// The steps that a walk tells of: as many as are counted, of nodes that the structure shows, and leading to the same hit.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "registry/matrix_geometry.h"
#include "registry/matrix_rays.h"
#include "registry/matrix_specs.h"

namespace grove::test {
namespace {

using Kind = TraversalStep::Kind;

std::vector<std::string> walked_specs() {
  std::vector<std::string> specs = representatives();
  for (const char* const spec : {"kdtree:walk=ropes", "kdtree:walk=ropes,mailbox=false", "octree:walk=neighbour", "octree-r:walk=neighbour",
                                 "octree:walk=neighbour,store=inner", "octree:store=inner", "bvh:arity=4", "bvh:arity=8",
                                 "bvh:bounds=obb,arity=4", "bvh:bounds=sphere", "bvh:split=spatial"})
    specs.emplace_back(canonical_spec(spec));
  std::ranges::sort(specs);
  specs.erase(std::unique(specs.begin(), specs.end()), specs.end());
  return specs;
}

std::uint64_t count_of(const TraversalRecord& record, std::initializer_list<Kind> kinds) {
  return static_cast<std::uint64_t>(
      std::ranges::count_if(record.steps, [&](const TraversalStep& step) { return std::ranges::find(kinds, step.kind) != kinds.end(); }));
}

/// What a structure shows of itself, by number.
struct Shown {
  explicit Shown(const Accelerator& structure) {
    structure.visit_nodes([&](const NodeView& node) {
      if (node.is_leaf && node.reference_count > 0) {
        EXPECT_TRUE(leaves.insert(node.number).second) << "leaf " << node.number;
      }
      if (node.is_leaf) all_leaves.insert(node.number);
      if (!node.is_leaf) {
        EXPECT_TRUE(interior.insert(node.number).second) << "node " << node.number;
      }
    });
  }

  std::set<std::uint32_t> interior;
  std::set<std::uint32_t> leaves;  // with references
  std::set<std::uint32_t> all_leaves;
};

class RecordedSteps : public testing::TestWithParam<std::string> {};

TEST_P(RecordedSteps, AreThoseThatAreCounted) {
  for (const NamedGeometry& geometry : matrix_geometries()) {
    SCOPED_TRACE(geometry.name);
    const std::unique_ptr<Accelerator> structure = build(geometry.geometry, GetParam());
    TraversalRecord record;
    for (const Ray& ray : matrix_rays(geometry.geometry, 6, 7)) {
      TraversalCounts counts;
      const Hit hit = structure->closest_hit(ray, &counts);
      ASSERT_TRUE(same_bits(hit, structure->record_steps(ray, record)));
      // Its kernels may come to children in another order than the plain walk, which is recorded.
      if (GetParam().starts_with("fast")) continue;
      // Brute force has no nodes; it counts one leaf.
      EXPECT_EQ(counts.nodes_visited, count_of(record, {Kind::node, Kind::cell, Kind::gap}) + record.nested.nodes_visited);
      EXPECT_EQ(counts.leaves_entered, count_of(record, {Kind::leaf}) + record.nested.leaves_entered);
      EXPECT_EQ(counts.primitives_tested, count_of(record, {Kind::test}) + record.nested.primitives_tested);
    }
  }
}

TEST_P(RecordedSteps, AreOfNodesThatAreShown) {
  if (GetParam() == "brute") return;
  for (const NamedGeometry& geometry : matrix_geometries()) {
    SCOPED_TRACE(geometry.name);
    const std::unique_ptr<Accelerator> structure = build(geometry.geometry, GetParam());
    const Shown shown(*structure);
    TraversalRecord record;
    for (const Ray& ray : matrix_rays(geometry.geometry, 6, 8)) {
      static_cast<void>(structure->record_steps(ray, record));
      float closest = ray.t_max;
      for (const TraversalStep& step : record.steps) {
        if (step.kind == Kind::node || step.kind == Kind::gap) {
          EXPECT_TRUE(shown.interior.contains(step.number));
        }
        if (step.kind == Kind::cell) {
          EXPECT_TRUE(shown.all_leaves.contains(step.number));
        }
        if (step.kind == Kind::leaf) {
          EXPECT_TRUE(shown.leaves.contains(step.number));
        }
        EXPECT_LE(step.closest, closest) << "the closest hit went away";
        closest = step.closest;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Specs, RecordedSteps, testing::ValuesIn(walked_specs()),
                         [](const auto& test) { return as_test_name(test.param); });

}  // namespace
}  // namespace grove::test
