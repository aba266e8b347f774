// Octree-R: the equations, by hand and against random lines, and the planes, against trying all.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "build/degenerate_meshes.h"
#include "build/sample_meshes.h"
#include "build/threads.h"
#include "grove/build/octree/build_octree.h"
#include "grove/build/octree/octree_r_candidates.h"
#include "grove/build/octree/octree_r_cost.h"
#include "grove/build/octree/octree_r_planes.h"

namespace grove {
namespace {

constexpr OctreeRSearch kSearches[] = {OctreeRSearch::candidates, OctreeRSearch::events, OctreeRSearch::joint};

// --- Equations.

TEST(OctreeRCost, HasTheChancesOfEquations6And7) {
  // A box of 4 * 2 * 1: half its surface is 4 * 3 + 2 = 14; at t = 1 that of A is 1 * 3 + 2 = 5, of B 3 * 3 + 2 = 11.
  const DividedSpace space{4.0, 2.0, 1.0};
  EXPECT_DOUBLE_EQ(chance_below(space, 1.0), 5.0 / 14.0);
  EXPECT_DOUBLE_EQ(chance_above(space, 1.0), 11.0 / 14.0);
  // A part that is all of it, and one that is only the wall.
  EXPECT_DOUBLE_EQ(chance_below(space, 4.0), 1.0);
  EXPECT_DOUBLE_EQ(chance_below(space, 0.0), 2.0 / 14.0);
}

TEST(OctreeRCost, HasTheTestsOfEquations8And9) {
  const DividedSpace space{4.0, 2.0, 1.0};
  const DividedCounts counts{6.0, 3.0, 2.0};  // n, m, s
  // By hand: 5/14 * 6 + 11/14 * 3 + 16/14 * 2.
  EXPECT_DOUBLE_EQ(expected_tests(space, 1.0, counts), (30.0 + 33.0 + 32.0) / 14.0);
  EXPECT_DOUBLE_EQ(expected_tests(chance_below(space, 1.0), chance_above(space, 1.0), counts), 95.0 / 14.0);
  // Equation 9 as it stands in the review.
  const double a = 4.0;
  const double b = 2.0;
  const double c = 1.0;
  for (const double t : {0.0, 0.5, 2.0, 3.7, 4.0}) {
    const double whole = a * (b + c) + b * c;
    const double equation_9 =
        (t * (b + c) + b * c) / whole * 6.0 + ((a - t) * (b + c) + b * c) / whole * 3.0 + (a * (b + c) + 2.0 * b * c) / whole * 2.0;
    EXPECT_NEAR(expected_tests(space, t, counts), equation_9, 1e-12);
  }
}

TEST(OctreeRCost, HasTheTimeOfEquation5) {
  EXPECT_DOUBLE_EQ(ray_cost(7.0, 20.0, 11.0, 30.0), 470.0);
}

TEST(OctreeRCost, TakesLengthsWhereThereIsNoArea) {
  EXPECT_DOUBLE_EQ(chance_below({4.0, 0.0, 0.0}, 1.0), 0.25);
  EXPECT_DOUBLE_EQ(chance_above({4.0, 0.0, 0.0}, 1.0), 0.75);
  EXPECT_DOUBLE_EQ(chance_below({0.0, 0.0, 0.0}, 0.0), 1.0);
}

TEST(OctreeRCost, OfAnOctantIsItsShareOfTheSurface) {
  const OctantCut cut{{Float4{0, 0, 0, 0}, Float4{4, 2, 1, 0}}, Float4{1, 0.5F, 0.25F, 0}, 7};
  // The lowest octant is 1 * 1/2 * 1/4: half its surface is 1/2 + 1/4 + 1/8.
  EXPECT_DOUBLE_EQ(chance_of_octant(cut, 0), 0.875 / 14.0);
  // The highest is 3 * 3/2 * 3/4.
  EXPECT_DOUBLE_EQ(chance_of_octant(cut, 7), (4.5 + 2.25 + 1.125) / 14.0);
}

// Whether a line meets a box.
bool meets(const glm::dvec3& origin, const glm::dvec3& direction, const glm::dvec3& lower, const glm::dvec3& upper) {
  double first = -1e30;
  double last = 1e30;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (lower[axis] - origin[axis]) / direction[axis];
    const double b = (upper[axis] - origin[axis]) / direction[axis];
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  return first <= last;
}

// Equations 3 and 6 hold for uniform lines and convex bodies: of all lines in space that pass through R, the share that passes through A. Such lines have a uniform
// direction, and cross a disc around the box, perpendicular to it, at a uniform point.
TEST(OctreeRCost, AgreesWithRandomLines) {
  const glm::dvec3 side(4.0, 2.0, 1.0);
  const DividedSpace space{side.x, side.y, side.z};
  const OctantCut cut{{Float4{0, 0, 0, 0}, Float4{4, 2, 1, 0}}, Float4{1, 0.5F, 0.25F, 0}, 7};
  Random random(11);
  int through_whole = 0;
  int through_below = 0;
  int through_above = 0;
  int through_octant[8] = {};
  constexpr double kPi = 3.14159265358979;
  const double radius = 0.5 * glm::length(side);
  for (int i = 0; i < 400000; ++i) {
    const double z = 2.0 * random.next_float() - 1.0;
    const double azimuth = 2.0 * kPi * random.next_float();
    const double across = std::sqrt(1.0 - z * z);
    const glm::dvec3 direction(across * std::cos(azimuth), across * std::sin(azimuth), z);
    const glm::dvec3 u = glm::normalize(glm::cross(direction, std::fabs(z) < 0.5 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)));
    const glm::dvec3 v = glm::cross(direction, u);
    const double from_centre = radius * std::sqrt(static_cast<double>(random.next_float()));
    const double around = 2.0 * kPi * random.next_float();
    const glm::dvec3 origin = 0.5 * side + from_centre * (std::cos(around) * u + std::sin(around) * v);
    if (!meets(origin, direction, glm::dvec3(0.0), side)) continue;
    ++through_whole;
    through_below += meets(origin, direction, glm::dvec3(0.0), {1.0, side.y, side.z}) ? 1 : 0;
    through_above += meets(origin, direction, {1.0, 0.0, 0.0}, side) ? 1 : 0;
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
      const Box box = cut.octant(octant).box();
      through_octant[octant] += meets(origin, direction, glm::dvec3(box.lower), glm::dvec3(box.upper)) ? 1 : 0;
    }
  }
  // Five standard deviations of a share.
  const auto expect_share = [&](int count, double expected) {
    const double share = static_cast<double>(count) / through_whole;
    EXPECT_NEAR(share, expected, 5.0 * std::sqrt(expected * (1.0 - expected) / through_whole)) << "of " << through_whole;
  };
  EXPECT_GT(through_whole, 50000);
  expect_share(through_below, chance_below(space, 1.0));
  expect_share(through_above, chance_above(space, 1.0));
  for (std::uint32_t octant = 0; octant < 8; ++octant) expect_share(through_octant[octant], chance_of_octant(cut, octant));
}

// --- Planes.

// Clustered towards a corner, with some that are flat or lie in planes of others.
struct Cell {
  ReferenceList list;
  std::vector<std::uint32_t> ids;
  Box4 box;

  explicit Cell(std::uint64_t seed) {
    Random random(seed);
    const std::size_t count = 1 + random.next_u32(60);
    for (std::uint32_t i = 0; i < count; ++i) {
      Vec3 corner = testing::random_point(random);
      corner = corner * corner;
      if (i % 3 == 0) corner = glm::floor(8.0F * corner) / 8.0F;
      Vec3 side = 0.3F * testing::random_point(random);
      if (i % 5 == 0) side[static_cast<int>(i % 3)] = 0.0F;
      const Box bounds{corner, corner + side};
      list.references.push_back(make_reference(bounds, i));
      list.bounds.grow(bounds);
    }
    ids.resize(count);
    std::iota(ids.begin(), ids.end(), 0U);
    // Some reach out of the cell.
    box = {to_float4(list.bounds.lower), to_float4(list.bounds.lower + 0.9F * list.bounds.extent())};
  }
};

class NoOverlapTest final : public OverlapTest {
 public:
  void narrow(const OctantCut& /*cut*/, std::span<const std::uint32_t> /*ids*/, std::uint8_t* /*octants*/) const override {}
};

// n(t), m(t) and s(t) by the definition, with the builder's rule for what only touches.
double tests_of_plane(const Cell& cell, int axis, float plane) {
  DividedCounts counts{0.0, 0.0, 0.0};
  for (const PrimitiveReference& reference : cell.list.references) {
    if (reference.upper[axis] <= plane) {
      ++counts.below;
    } else if (reference.lower[axis] >= plane) {
      ++counts.above;
    } else {
      ++counts.across;
    }
  }
  const auto side = [&](int i) { return static_cast<double>(cell.box.upper[i]) - static_cast<double>(cell.box.lower[i]); };
  return expected_tests({side(axis), side((axis + 1) % 3), side((axis + 2) % 3)},
                        static_cast<double>(plane) - static_cast<double>(cell.box.lower[axis]), counts);
}

double tests_of_octants(const Cell& cell, const OctantCut& cut) {
  double tests = 0.0;
  for (const PrimitiveReference& reference : cell.list.references)
    for (std::uint32_t octant = 0; octant < 8; ++octant)
      if ((cut.octants_of(reference) >> octant & 1U) != 0) tests += chance_of_octant(cut, octant);
  return tests;
}

TEST(OctreeRPlanes, AreTheBestOfTheCandidates) {
  const NoOverlapTest overlap;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Cell cell(seed);
    const OctantSource source{cell.list.references, overlap};
    OctreeRPlanes::Scratch scratch;
    const OctantCut cut = OctreeRPlanes(OctreeRSearch::candidates, 7).choose(source, cell.box, cell.ids, scratch);
    for (int axis = 0; axis < 3; ++axis) {
      // The candidates by their definition: seven from one median to the other.
      const float median = object_median({source, cell.ids}, cell.box, axis, scratch.ends[0]);
      const float middle = 0.5F * cell.box.lower[axis] + 0.5F * cell.box.upper[axis];
      const float from = std::min(middle, median);
      const float to = std::max(middle, median);
      double least = std::numeric_limits<double>::infinity();
      for (int i = 0; i < 7; ++i) {
        const float share = static_cast<float>(i) / 6.0F;
        const float plane = from * (1.0F - share) + to * share;
        if (cell.box.lower[axis] < plane && plane < cell.box.upper[axis]) least = std::min(least, tests_of_plane(cell, axis, plane));
      }
      EXPECT_EQ((cut.axes >> axis & 1U) != 0, std::isfinite(least));
      if ((cut.axes >> axis & 1U) == 0) continue;
      EXPECT_EQ(tests_of_plane(cell, axis, cut.planes[axis]), least) << seed;
    }
  }
}

TEST(OctreeRPlanes, OfEventsAreTheBestOfAll) {
  const NoOverlapTest overlap;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Cell cell(seed);
    OctreeRPlanes::Scratch scratch;
    const OctantCut cut = OctreeRPlanes(OctreeRSearch::events, 8).choose({cell.list.references, overlap}, cell.box, cell.ids, scratch);
    Random random(seed);
    for (int axis = 0; axis < 3; ++axis) {
      double least = std::numeric_limits<double>::infinity();
      for (const PrimitiveReference& reference : cell.list.references)
        for (const float end : {static_cast<float>(reference.lower[axis]), static_cast<float>(reference.upper[axis])})
          if (cell.box.lower[axis] < end && end < cell.box.upper[axis]) least = std::min(least, tests_of_plane(cell, axis, end));
      EXPECT_EQ((cut.axes >> axis & 1U) != 0, std::isfinite(least));
      if ((cut.axes >> axis & 1U) == 0) continue;
      EXPECT_EQ(tests_of_plane(cell, axis, cut.planes[axis]), least) << seed;
      // No plane elsewhere is better, but for those at the very ends of the cell.
      for (int i = 0; i < 50; ++i) {
        const float plane = cell.box.lower[axis] + (cell.box.upper[axis] - cell.box.lower[axis]) * random.next_float(0.05F, 0.95F);
        const auto is_between = [&](const PrimitiveReference& reference) {
          return reference.lower[axis] > cell.box.lower[axis] && reference.lower[axis] <= plane;
        };
        const bool has_event_below = std::any_of(cell.list.references.begin(), cell.list.references.end(), is_between);
        const bool has_event_above = std::any_of(cell.list.references.begin(), cell.list.references.end(), [&](const auto& reference) {
          return reference.upper[axis] < cell.box.upper[axis] && reference.upper[axis] >= plane;
        });
        if (!has_event_below || !has_event_above) continue;
        EXPECT_GE(tests_of_plane(cell, axis, plane), least * (1.0 - 1e-9)) << seed;
      }
    }
  }
}

TEST(OctreeRPlanes, ChosenJointlyAreTheBestTriple) {
  const NoOverlapTest overlap;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Cell cell(seed);
    const OctantSource source{cell.list.references, overlap};
    OctreeRPlanes::Scratch scratch;
    const OctantCut cut = OctreeRPlanes(OctreeRSearch::joint, 5).choose(source, cell.box, cell.ids, scratch);
    const OctreeRCandidates candidates({source, cell.ids}, cell.box, 5, scratch.ends);
    double least = std::numeric_limits<double>::infinity();
    const auto at = [&](int axis, std::size_t i) {
      return i < candidates.counts[axis] ? static_cast<float>(candidates.planes[i][axis]) : static_cast<float>(cell.box.upper[axis]);
    };
    for (std::size_t x = 0; x < std::max<std::size_t>(candidates.counts[0], 1); ++x)
      for (std::size_t y = 0; y < std::max<std::size_t>(candidates.counts[1], 1); ++y)
        for (std::size_t z = 0; z < std::max<std::size_t>(candidates.counts[2], 1); ++z)
          least = std::min(least, tests_of_octants(cell, {cell.box, Float4{at(0, x), at(1, y), at(2, z), 0.0F}, cut.axes}));
    EXPECT_NEAR(tests_of_octants(cell, cut), least, 1e-9 * least) << seed;
    // And so at least as good as the best of each axis on its own.
    const OctantCut apart = OctreeRPlanes(OctreeRSearch::candidates, 5).choose(source, cell.box, cell.ids, scratch);
    EXPECT_LE(tests_of_octants(cell, cut), tests_of_octants(cell, apart) * (1.0 + 1e-9)) << seed;
  }
}

// --- Trees.

OctreeSettings octree_r(OctreeRSearch search) {
  return {.split = OctreeSplit::octree_r, .search = search};
}

TEST(OctreeR, IsWholeAndBoundedForDegenerateSets) {
  for (const auto& [name, mesh] : testing::degenerate_meshes()) {
    SCOPED_TRACE(name);
    for (const OctreeRSearch search : kSearches) {
      const Octree tree = build_octree(mesh, octree_r(search));
      ASSERT_EQ(tree.validate(mesh.size()), "");
      EXPECT_LE(tree.depth, 10U);
      const std::set<std::uint32_t> referenced(tree.references.begin(), tree.references.end());
      std::size_t hittable = 0;
      for (std::uint32_t i = 0; i < mesh.size(); ++i) hittable += mesh.bounds(i).is_empty() ? 0 : 1;
      EXPECT_EQ(referenced.size(), hittable);
      EXPECT_LE(tree.references.size(), 8 * hittable);
    }
  }
}

TEST(OctreeR, StopsWhereCuttingCostsMoreThanItSaves) {
  // Two triangles across each other in one place, four times: no plane parts them, so that each place is one leaf.
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  for (const float x : {0.0F, 10.0F}) {
    for (const float y : {0.0F, 10.0F}) {
      const Vec3 at(x, y, 0.0F);
      const auto first = static_cast<std::uint32_t>(vertices.size());
      vertices.insert(vertices.end(),
                      {at, at + Vec3(1, 1, 0), at + Vec3(0, 1, 1), at + Vec3(1, 0, 0), at + Vec3(0, 1, 0), at + Vec3(1, 1, 1)});
      triangles.insert(triangles.end(), {{first, first + 1, first + 2}, {first + 3, first + 4, first + 5}});
    }
  }
  const TriangleMesh mesh(std::move(vertices), std::move(triangles));
  OctreeSettings settings = octree_r(OctreeRSearch::events);
  settings.leaf_size = 1;
  const Octree tree = build_octree(mesh, settings);
  EXPECT_EQ(tree.leaf_count(), 4U);
  EXPECT_EQ(tree.references.size(), 8U);
  // An octree cuts on.
  settings.split = OctreeSplit::median;
  EXPECT_GT(build_octree(mesh, settings).leaf_count(), 4U);
}

// Where primitives are scattered evenly, planes that go by cost save tests at no more leaves: they cut fewer primitives.
TEST(OctreeR, NeedsFewerTestsThanAnOctreeOfAsManyLeaves) {
  const TriangleMesh mesh = testing::pebbles(6000, 0.02F, 13);
  const Octree plain = build_octree(mesh, {.leaf_size = 4});
  for (const OctreeRSearch search : kSearches) {
    OctreeSettings settings = octree_r(search);
    settings.leaf_size = 4;
    const Octree tree = build_octree(mesh, settings);
    EXPECT_LE(tree.leaf_count(), plain.leaf_count());
    EXPECT_LT(expected_cost(tree, {.traversal = 0.0}), expected_cost(plain, {.traversal = 0.0}));
  }
}

TEST(OctreeR, IsTheSameForAnyNumberOfThreads) {
  const TriangleMesh mesh = testing::pebbles(100000, 0.02F, 7);
  for (const OctreeRSearch search : kSearches) {
    OctreeSettings settings = octree_r(search);
    if (search == OctreeRSearch::joint) settings.candidate_count = 3;
    const auto build = [&] { return build_octree(mesh, settings); };
    const Octree first = testing::with_threads(1, build);
    EXPECT_EQ(first.validate(mesh.size()), "");
    for (const int threads : {3, 8}) {
      const Octree other = testing::with_threads(threads, build);
      EXPECT_TRUE(other.nodes == first.nodes && other.leaf_first == first.leaf_first && other.references == first.references) << threads;
    }
  }
}

}  // namespace
}  // namespace grove
