#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "build/exact_overlap.h"
#include "build/hand_made_bvh.h"
#include "build/sample_meshes.h"
#include "build/threads.h"
#include "grove/build/bottom_up/lbvh.h"
#include "grove/build/passes/collapse.h"
#include "grove/build/passes/rebound.h"
#include "grove/build/quality/measure_quality.h"
#include "grove/build/spatial_splits.h"
#include "grove/geometry/user_geometry.h"

namespace grove {
namespace {

using testing::TreeSketch;

// Takes the part from x = `low` to x = `high` of a bar of unit cross-section.
Box bar(float low, float high) {
  return {{low, 0, 0}, {high, 1, 1}};
}

double overlap_of(const TreeSketch& sketch) {
  return sibling_overlap(PreorderNodes(testing::make_bvh(sketch), 8));
}

TEST(SiblingOverlap, IsNoneForBoxesApartAndOneForTheSameBox) {
  EXPECT_EQ(overlap_of({TreeSketch(bar(0, 1), {0}), TreeSketch(bar(2, 3), {1})}), 0.0);
  EXPECT_EQ(overlap_of({TreeSketch(bar(0, 1), {0}), TreeSketch(bar(0, 1), {1})}), 1.0);
  EXPECT_EQ(overlap_of({bar(0, 1), {0, 1}}), 0.0) << "a single leaf";
  EXPECT_EQ(sibling_overlap(PreorderNodes(Bvh2{}, 0)), 0.0);
}

TEST(SiblingOverlap, MatchesTheSumByHand) {
  // Half areas of bars of length l: 2 l + 1. Root [0, 4]: 9, its children share [1, 2]: 3. Left [0, 2]: 5, children share the face at 1: 1.
  // Right [1, 4]: 7, children are apart.
  const TreeSketch left(TreeSketch(bar(0, 1), {0}), TreeSketch(bar(1, 2), {1}));
  const TreeSketch right(TreeSketch(bar(1, 2), {2}), TreeSketch(bar(3, 4), {3}));
  EXPECT_DOUBLE_EQ(overlap_of({left, right}), (3.0 + 1.0) / (9.0 + 5.0 + 7.0));
}

TEST(SiblingOverlap, CountsEachPairOfAWideNode) {
  const TreeSketch left(TreeSketch(bar(0, 2), {0}), TreeSketch(bar(1, 3), {1}));
  const TreeSketch right(TreeSketch(bar(2, 4), {2}), TreeSketch(bar(1, 4), {3}));
  const WideBvh<4> wide = widen<4>(testing::make_bvh({left, right}), {.leaf_size = 1});
  ASSERT_EQ(wide.nodes.size(), 1U);
  // Common parts, in the order of pairs: [1,2], {2}, [1,2], [2,3], [1,3], [2,4].
  EXPECT_DOUBLE_EQ(sibling_overlap(PreorderNodes(wide, 4)), (3.0 + 1.0 + 3.0 + 3.0 + 5.0 + 5.0) / 9.0);
}

// Two triangles of equal area in the planes x = 1 and x = 2; the box of the second reaches over the first.
TEST(EndPointOverlap, MatchesTheSumByHand) {
  const TriangleMesh mesh({{1, 0, 0}, {1, 1, 0}, {1, 0, 1}, {2, 0, 0}, {2, 1, 0}, {2, 0, 1}}, {{0, 1, 2}, {3, 4, 5}});
  const Bvh2 bvh = testing::make_bvh({TreeSketch(bar(1, 1), {0}), TreeSketch(bar(0.5F, 2), {1})});
  const CostModel model{.traversal = 5.0, .intersection = 3.0};
  const auto overlap = measure_quality(bvh, mesh, {.cost = model, .sample_count = 1000}).end_point_overlap;
  ASSERT_TRUE(overlap);
  // All of triangle 0, half of the surface, lies in the leaf of triangle 1; strata split the samples evenly, so that is exact.
  EXPECT_DOUBLE_EQ(overlap->value, 0.5 * 3.0);
  EXPECT_EQ(overlap->sample_count, 1000U);
}

TEST(EndPointOverlap, WholeSubtreesAreEnteredForNothing) {
  const TriangleMesh mesh({{1, 0, 0}, {1, 1, 0}, {1, 0, 1}, {2, 0, 0}, {2, 1, 0}, {2, 0, 1}}, {{0, 1, 2}, {3, 4, 5}, {3, 4, 5}});
  const TreeSketch below(TreeSketch(bar(0.5F, 2), {1}), TreeSketch(bar(2, 2), {2}));
  const Bvh2 bvh = testing::make_bvh({TreeSketch(bar(1, 1), {0}), below});
  const CostModel model{.traversal = 5.0, .intersection = 3.0};
  // From triangle 0: the node and its first leaf. From 1 and 2: the other's leaf, which both reach to x = 2.
  EXPECT_DOUBLE_EQ(measure_quality(bvh, mesh, {.cost = model, .sample_count = 3000}).end_point_overlap->value,
                   (5.0 + 3.0) / 3.0 + 3.0 * 2.0 / 3.0);
}

TEST(EndPointOverlap, NoneOfASphereIsCountedWhereItIsHeld) {
  const SphereSet spheres({{.centre = {0, 0, 0}, .radius = 1.0F}, {.centre = {5, 0, 0}, .radius = 1e-3F}});
  // The second leaf's box holds the upper quarter of the first sphere: slices of equal height have equal area.
  const Bvh2 bvh = testing::make_bvh({TreeSketch({{-1, -1, -1}, {1, 1, 1}}, {0}), TreeSketch({{-1, -1, 0.5F}, {6, 1, 1}}, {1})});
  const auto overlap = measure_quality(bvh, spheres).end_point_overlap;
  ASSERT_TRUE(overlap);
  EXPECT_NEAR(overlap->value, 0.25 * CostModel{}.intersection, 1e-4);
}

// Two small triangles in a sphere each, of which the second reaches over the first triangle but not over its own node's sphere everywhere.
TEST(EndPointOverlap, OtherVolumesCountWhereAllAboveContainTheEnd) {
  const TriangleMesh mesh({{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {4, 0, 0}, {4, 1, 0}, {4, 0, 1}}, {{0, 1, 2}, {3, 4, 5}, {3, 4, 5}});
  const auto sphere = [](float x, float radius, std::uint32_t first, std::uint32_t count, bool is_leaf) {
    return VolumeNode<BoundingSphere>{{{x, 0, 0}, radius}, first, count, is_leaf ? 1U : 0U};
  };
  VolumeBvh<BoundingSphere> bvh;
  bvh.references.assign({0, 1, 2});
  bvh.bounds = {{0, 0, 0}, {4, 1, 1}};
  bvh.depth = 2;
  const CostModel model{.traversal = 5.0, .intersection = 3.0};
  const auto overlap = [&] { return measure_quality(bvh, mesh, {.cost = model, .sample_count = 3000}).end_point_overlap->value; };
  // The node above triangles 1 and 2 is apart from triangle 0, its second leaf reaches all over it.
  bvh.nodes.assign(
      {sphere(2, 9, 1, 2, false), sphere(0, 2, 0, 1, true), sphere(4, 2, 3, 2, false), sphere(4, 2, 1, 1, true), sphere(4, 9, 2, 1, true)});
  ASSERT_EQ(bvh.validate(3), "");
  EXPECT_DOUBLE_EQ(overlap(), 3.0 * 2.0 / 3.0) << "triangles 1 and 2, each in the other's leaf";
  bvh.nodes[2].volume.radius = 9;
  EXPECT_DOUBLE_EQ(overlap(), (5.0 + 3.0) / 3.0 + 3.0 * 2.0 / 3.0) << "besides triangle 0 in the node and one leaf";
}

// Rods side by side along a diagonal: turned boxes are apart where axis-aligned ones are not, and balls are worst.
TEST(EndPointOverlap, TellsVolumesApart) {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < 64; ++i) {
    const Vec3 start(0.1F * static_cast<float>(i), -0.1F * static_cast<float>(i), 0);
    vertices.insert(vertices.end(), {start, start + Vec3(8, 8, 8), start + Vec3(8.02F, 8, 8)});
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const TriangleMesh mesh(std::move(vertices), std::move(triangles));
  const Bvh2 bvh = build_top_down(list_references(mesh), {.leaf_size = 1});
  const auto hulls = list_hulls(mesh, bvh.references);
  const CollapseSettings settings{.arity = 2, .leaf_size = 1};
  const double boxes = measure_quality(bvh, mesh).end_point_overlap->value;
  const double oriented_boxes = measure_quality(rebound<OrientedBox>(bvh, hulls, settings), mesh).end_point_overlap->value;
  const StructureQuality spheres = measure_quality(rebound<BoundingSphere>(bvh, hulls, settings), mesh);
  EXPECT_LT(oriented_boxes, 0.1 * boxes);
  EXPECT_GT(spheres.end_point_overlap->value, boxes);
  EXPECT_FALSE(spheres.sibling_overlap);
  EXPECT_EQ(spheres.duplication, 1.0);
}

// A divided primitive is held by every node that has a piece of it, and by none of the others.
TEST(PreorderNodes, KnowsWhichSubtreesHoldAPrimitive) {
  const TriangleMesh mesh = testing::slivers(500, 11);
  const Bvh2 bvh = build_with_spatial_splits(mesh, {.leaf_size = 2});
  const PreorderNodes hierarchy(bvh, mesh.size());
  EXPECT_GT(hierarchy.reference_count(), mesh.size());
  EXPECT_EQ(hierarchy.referenced_primitive_count(), mesh.size());
  std::uint32_t number = 0;
  std::vector<std::set<std::uint32_t>> held(hierarchy.nodes().size());
  std::vector<std::uint32_t> open;
  bvh.visit([&](const Box& /*box*/, std::uint32_t depth, std::uint32_t first, std::uint32_t count) {
    open.resize(depth);
    open.push_back(number++);
    EXPECT_EQ(hierarchy.is_leaf(open.back()), count > 0);
    for (std::uint32_t i = first; i < first + count; ++i)
      for (const std::uint32_t above : open) held[above].insert(bvh.references[i]);
  });
  for (std::uint32_t node = 0; node < number; ++node)
    for (std::uint32_t primitive = 0; primitive < mesh.size(); ++primitive)
      ASSERT_EQ(hierarchy.holds(hierarchy.nodes()[node], primitive), held[node].contains(primitive)) << node << " " << primitive;
}

TEST(EndPointOverlap, EstimateAgreesWithClippedAreas) {
  for (const TriangleMesh& mesh : {testing::slivers(300, 12), testing::pebbles(2000, 0.1F, 13)}) {
    const ReferenceList list = list_references(mesh);
    const auto compare = [&](const auto& hierarchy, const char* name) {
      const double exact = testing::exact_end_point_overlap(hierarchy, mesh, CostModel{});
      const auto estimate = measure_quality(hierarchy, mesh).end_point_overlap;
      ASSERT_TRUE(estimate);
      EXPECT_GT(exact, 0.1) << name;
      EXPECT_LT(estimate->error, 0.02 * exact) << name;
      EXPECT_NEAR(estimate->value, exact, 4.0 * estimate->error) << name;
    };
    compare(build_top_down(list, {}), "binned");
    compare(build_lbvh(list, {}), "lbvh");
    compare(build_with_spatial_splits(mesh, {}), "spatial");
    compare(widen<8>(build_with_spatial_splits(mesh, {.leaf_size = 1}), {}), "spatial, eight wide");
  }
}

// Over many seeds the mean comes closer to the exact value than one estimate, and the estimates spread as their errors say.
TEST(EndPointOverlap, EstimateIsWithoutBiasAndKnowsItsError) {
  const TriangleMesh mesh = testing::pebbles(200, 0.3F, 14);
  const Bvh2 bvh = build_top_down(list_references(mesh), {});
  const double exact = testing::exact_end_point_overlap(bvh, mesh, CostModel{});
  constexpr int kRuns = 400;
  double sum = 0.0;
  double squared_deviations = 0.0;
  double squared_errors = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    const auto estimate =
        measure_quality(bvh, mesh, {.sample_count = 512, .seed = static_cast<std::uint64_t>(run)}).end_point_overlap.value();
    sum += estimate.value;
    squared_deviations += (estimate.value - exact) * (estimate.value - exact);
    squared_errors += estimate.error * estimate.error;
  }
  const double deviation = std::sqrt(squared_deviations / kRuns);
  const double error = std::sqrt(squared_errors / kRuns);
  EXPECT_NEAR(sum / kRuns, exact, 4.0 * deviation / std::sqrt(kRuns));
  EXPECT_LT(deviation, 1.1 * error);
  EXPECT_GT(deviation, 0.5 * error);
}

TEST(MeasureQuality, DoesNotDependOnTheThreads) {
  const TriangleMesh mesh = testing::pebbles(20000, 0.05F, 15);
  const Bvh2 bvh = build_top_down(list_references(mesh), {});
  const auto measure_with = [&](int threads) { return testing::with_threads(threads, [&] { return measure_quality(bvh, mesh); }); };
  const StructureQuality one = measure_with(1);
  const StructureQuality three = measure_with(3);
  EXPECT_EQ(one.end_point_overlap->value, three.end_point_overlap->value);
  EXPECT_EQ(one.end_point_overlap->error, three.end_point_overlap->error);
  EXPECT_EQ(one.sibling_overlap, three.sibling_overlap);
}

TEST(MeasureQuality, LeavesOutWhatCannotBeMeasured) {
  class Boxes final : public UserGeometry {
   public:
    [[nodiscard]] std::size_t size() const override { return 10; }
    [[nodiscard]] Box bounds(std::size_t i) const override { return bar(static_cast<float>(i), static_cast<float>(i) + 2.0F); }
    [[nodiscard]] bool intersect_primitive(std::size_t /*i*/, const Ray& /*ray*/, Hit& /*hit*/) const override { return false; }
  };
  const Boxes boxes;
  const StructureQuality without_surfaces =
      measure_quality(build_top_down(list_references<UserGeometry>(boxes), {.leaf_size = 1}), static_cast<const UserGeometry&>(boxes));
  EXPECT_FALSE(without_surfaces.end_point_overlap);
  EXPECT_GT(without_surfaces.sibling_overlap.value(), 0.0);
  EXPECT_EQ(without_surfaces.duplication, 1.0);

  // Nothing, and triangles without area or finite corners.
  EXPECT_FALSE(measure_quality(Bvh2{}, TriangleMesh()).end_point_overlap);
  EXPECT_FALSE(measure_quality(Bvh2{}, TriangleMesh()).duplication);
  const TriangleMesh degenerate({{0, 0, 0}, {1, 1, 1}, {NAN, 0, 0}}, {{0, 1, 1}, {0, 1, 2}, {0, 0, 0}});
  EXPECT_FALSE(measure_quality(build_top_down(list_references(degenerate), {}), degenerate).end_point_overlap);
}

}  // namespace
}  // namespace grove
