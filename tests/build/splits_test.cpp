// The heuristics of the top-down builder, each on ranges whose best split is known.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "build/sample_meshes.h"
#include "grove/build/spatial_splits.h"
#include "grove/build/splits/object_median.h"
#include "grove/build/splits/spatial_median.h"
#include "grove/build/splits/sweep.h"

namespace grove {
namespace {

using testing::slivers;

SplitContext context_of(const ReferenceList& list, const CostModel& model = {}) {
  return {AreaMeasure(list.bounds).scale(), SubsetTime(model)};
}

float half_area(const std::vector<Box>& boxes, const std::vector<bool>& goes_left, bool side, std::uint32_t& count) {
  Box box;
  count = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (goes_left[i] != side) continue;
    box.grow(boxes[i]);
    ++count;
  }
  const Vec3 d = box.upper - box.lower;
  return d.x * (d.y + d.z) + d.y * d.z;
}

TEST(Sweep, FindsTheCheapestOfAllObjectSplits) {
  const TriangleMesh mesh = slivers(60, 3);
  const ReferenceList list = list_references(mesh);
  const SplitContext context = context_of(list);
  SweepHeuristic::Scratch scratch;
  const OrderedSplit split = SweepHeuristic(context).find(measure_all(list.references), list.references, scratch);
  ASSERT_TRUE(split.is_possible);

  float cheapest = std::numeric_limits<float>::infinity();
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < mesh.size(); ++i) boxes.push_back(mesh.bounds(i));
  for (int axis = 0; axis < 3; ++axis) {
    for (const Box& border : boxes) {
      std::vector<bool> goes_left;
      for (const Box& box : boxes) goes_left.push_back(box.lower[axis] + box.upper[axis] < border.lower[axis] + border.upper[axis]);
      std::uint32_t left = 0;
      std::uint32_t right = 0;
      const float left_area = half_area(boxes, goes_left, true, left);
      const float right_area = half_area(boxes, goes_left, false, right);
      if (left == 0) continue;
      cheapest =
          std::min(cheapest, (left_area * context.time(left) + right_area * context.time(right)) * context.area_scale * context.area_scale);
    }
  }
  EXPECT_NEAR(split.cost, cheapest, 1e-4F * cheapest);
}

TEST(Sweep, FindsTheSameSplitInParallel) {
  const TriangleMesh mesh = slivers(40000, 4);
  const ReferenceList list = list_references(mesh);
  const SweepHeuristic heuristic(context_of(list));
  SweepHeuristic::Scratch scratch;
  const ReferenceRange range = measure_all(list.references);
  const OrderedSplit one = heuristic.find(range, list.references, scratch);
  const OrderedSplit many = heuristic.find_in_parallel(range, list.references);
  EXPECT_EQ(one.first_right, many.first_right);
  EXPECT_EQ(one.axis, many.axis);
}

TEST(ObjectMedian, PutsHalfOnEachSide) {
  for (const std::size_t count : {2U, 7U, 1000U}) {
    const ReferenceList list = list_references(slivers(count, 5));
    ObjectMedianHeuristic::Scratch keys;
    const OrderedSplit split = ObjectMedianHeuristic(context_of(list)).find(measure_all(list.references), list.references, keys);
    EXPECT_EQ(split.left_count, count / 2);
    EXPECT_EQ(split.right_count, count - count / 2);
  }
}

TEST(ObjectMedian, HalvesPrimitivesWithOneCentre) {
  const std::vector<Vec3> vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const ReferenceList list = list_references(TriangleMesh(vertices, std::vector<Triangle>(9, Triangle(0, 1, 2))));
  ObjectMedianHeuristic::Scratch keys;
  EXPECT_EQ(ObjectMedianHeuristic(context_of(list)).find(measure_all(list.references), list.references, keys).left_count, 4U);
}

TEST(SpatialMedian, CutsTheLongestAxisInTheMiddle) {
  // Small triangles at x = 0, 1, 2 and 10: the middle of the box is 5.
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  for (const float x : {0.0F, 1.0F, 2.0F, 10.0F}) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), {{x, 0, 0}, {x, 1, 0}, {x, 0, 1}});
    triangles.push_back({first, first + 1, first + 2});
  }
  const ReferenceList list = list_references(TriangleMesh(vertices, triangles));
  SpatialMedianHeuristic::Scratch scratch;
  const PlaneSplit split = SpatialMedianHeuristic(context_of(list)).find(measure_all(list.references), list.references, scratch);
  EXPECT_EQ(split.axis, 0);
  EXPECT_EQ(split.doubled_plane, 10.0F);
  EXPECT_EQ(split.left_count, 3U);
  EXPECT_EQ(split.right_count, 1U);
}

TEST(SubsetTime, CountsSubtreesOnlyInEquationTwo) {
  const SubsetTime standard(CostModel{.traversal = 2.0, .intersection = 0.5, .split_cost = SplitCost::standard});
  const SubsetTime as_written(CostModel{.traversal = 2.0, .intersection = 0.5, .split_cost = SplitCost::equation_2});
  EXPECT_EQ(standard(8), 4.0F);
  EXPECT_EQ(as_written(1), 2.5F);             // one step, one test
  EXPECT_EQ(as_written(8), 2.0F * 4 + 4.0F);  // four levels of a balanced tree, eight tests
}

TEST(SpatialGrid, TellsBinsAsItsPlanesDo) {
  const SpatialGrid grid(Box4{Float4{-1.0F, 0.0F, 0.0F, 0.0F}, Float4{2.0F, 1.0F, 1.0F, 0.0F}}, 0);
  ASSERT_TRUE(grid.is_usable());
  for (int i = 0; i <= kSpatialBinCount; ++i) {
    const float plane = grid.plane(i);
    for (const float x : {std::nextafter(plane, -9.0F), plane, std::nextafter(plane, 9.0F)}) {
      if (x < -1.0F || x > 2.0F) continue;
      const int first = grid.first_bin(x);
      EXPECT_LE(grid.plane(first), x);
      EXPECT_TRUE(first + 1 == kSpatialBinCount || x < grid.plane(first + 1));
      const int last = grid.last_bin(x, 0);
      EXPECT_LE(x, grid.plane(last + 1));
      EXPECT_TRUE(last == 0 || x > grid.plane(last));
    }
  }
}

// Every point of a primitive lies in a leaf that names the primitive: nothing was cut away.
TEST(SpatialSplits, LeaveNoPointOfAPrimitiveOut) {
  const TriangleMesh mesh = slivers(400, 6);
  const Bvh2 bvh = build_with_spatial_splits(mesh, {.leaf_size = 2});
  ASSERT_EQ(bvh.validate(mesh.size()), "");
  EXPECT_GT(bvh.references.size(), mesh.size());
  EXPECT_LE(bvh.references.size(), 2 * mesh.size());
  std::vector<std::vector<Box>> boxes(mesh.size());
  bvh.visit([&](const Box& box, std::uint32_t /*depth*/, std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t i = first; i < first + count; ++i) boxes[bvh.references[i]].push_back(box);
  });
  Random random(7);
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    const Triangle& triangle = mesh.triangles()[i];
    for (int sample = 0; sample < 50; ++sample) {
      float u = random.next_float();
      float v = random.next_float();
      if (u + v > 1.0F) {
        u = 1.0F - u;
        v = 1.0F - v;
      }
      const Vec3 a = mesh.vertices()[triangle.x];
      const Vec3 point = a + u * (mesh.vertices()[triangle.y] - a) + v * (mesh.vertices()[triangle.z] - a);
      const bool is_covered = std::any_of(boxes[i].begin(), boxes[i].end(), [&](const Box& box) {
        return Box{box.lower - Vec3(1e-6F), box.upper + Vec3(1e-6F)}.contains(Box{point, point});
      });
      ASSERT_TRUE(is_covered) << "triangle " << i;
    }
  }
}

TEST(SpatialSplits, LowerTheCostOfSlivers) {
  const TriangleMesh mesh = slivers(3000, 8);
  const Bvh2 whole = build_top_down(list_references(mesh), {});
  const Bvh2 cut = build_with_spatial_splits(mesh, {});
  EXPECT_LT(expected_cost(cut, {}), 0.95 * expected_cost(whole, {}));
}

TEST(SpatialSplits, KeepToTheirBudget) {
  const TriangleMesh mesh = slivers(3000, 9);
  for (const double budget : {0.0, 0.1, 0.5}) {
    const Bvh2 bvh = build_with_spatial_splits(mesh, {.duplication_budget = budget});
    EXPECT_EQ(bvh.validate(mesh.size()), "");
    EXPECT_LE(static_cast<double>(bvh.references.size()), (1.0 + budget) * static_cast<double>(mesh.size()));
  }
}

// No two boxes overlap by more than the box around both.
TEST(SpatialSplits, AreTriedOnlyWhereSidesOverlapEnough) {
  const TriangleMesh mesh = slivers(3000, 11);
  const auto references = [&](double least_overlap) {
    return build_with_spatial_splits(mesh, {.least_overlap_of_range = least_overlap}).references.size();
  };
  EXPECT_EQ(references(1.0), mesh.size());
  EXPECT_GT(references(0.2), mesh.size());
  EXPECT_LE(references(0.2), references(0.0));
}

TEST(SpatialSplits, NameNoPrimitiveTwiceInALeaf) {
  const TriangleMesh mesh = slivers(2000, 10);
  const Bvh2 bvh = build_with_spatial_splits(mesh, {});
  bvh.visit([&](const Box& /*box*/, std::uint32_t /*depth*/, std::uint32_t first, std::uint32_t count) {
    std::vector<std::uint32_t> leaf(bvh.references.begin() + first, bvh.references.begin() + first + count);
    std::sort(leaf.begin(), leaf.end());
    EXPECT_EQ(std::adjacent_find(leaf.begin(), leaf.end()), leaf.end());
  });
}

}  // namespace
}  // namespace grove
