// Octrees as wholes: what lies in which leaf, limits, degenerate sets, threads. Hits are checked in tests/registry.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include "build/degenerate_meshes.h"
#include "build/sample_meshes.h"
#include "build/threads.h"
#include "grove/build/octree/build_octree.h"
#include "grove/geometry/sphere_set.h"

namespace grove {
namespace {

constexpr OctreeStore kStores[] = {OctreeStore::leaf, OctreeStore::inner};

// Each point of each triangle, up to rounding, lies in the cell of a leaf that refers to the triangle.
void expect_points_in_their_leaves(const Octree& tree, const TriangleMesh& mesh) {
  std::vector<std::vector<Box>> cells(mesh.size());
  tree.visit([&](const Octree::Visited& visited) {
    for (std::uint32_t i = visited.first; i < visited.first + visited.count; ++i) cells[tree.references[i]].push_back(visited.cell);
  });
  Random random(1);
  std::size_t lost = 0;
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    if (mesh.bounds(i).is_empty()) continue;
    for (int sample = 0; sample < 8; ++sample) {
      // Corners and edges among them.
      const double u = sample < 2 ? 0.0 : random.next_float();
      const double v = sample == 0 || sample == 4 ? 0.0 : random.next_float();
      const Vec3 p(mesh.surface_point(i, u, v));
      const Box around{p - Vec3(1e-6F), p + Vec3(1e-6F)};
      lost +=
          std::none_of(cells[i].begin(), cells[i].end(), [&](const Box& cell) { return !cell.intersection(around).is_empty(); }) ? 1 : 0;
    }
  }
  EXPECT_EQ(lost, 0U);
}

TEST(Octree, HasEachPointInALeafThatRefersToIt) {
  for (const OctreeStore store : kStores) {
    for (const TriangleMesh& mesh : {testing::pebbles(3000, 0.1F, 2), testing::slivers(1000, 3)}) {
      const Octree tree = build_octree(mesh, {.store = store});
      EXPECT_EQ(tree.validate(mesh.size()), "");
      expect_points_in_their_leaves(tree, mesh);
    }
  }
}

TEST(Octree, RefersOnlyToWhatALeafTrulyOverlaps) {
  const TriangleMesh mesh = testing::slivers(1000, 4);
  const Octree tree = build_octree(mesh, {});
  std::size_t wrong = 0;
  tree.visit([&](const Octree::Visited& visited) {
    for (std::uint32_t i = visited.first; i < visited.first + visited.count; ++i)
      wrong += mesh.overlaps(tree.references[i], visited.cell) ? 0 : 1;
  });
  EXPECT_EQ(wrong, 0U);
  // Boxes of slivers overlap many more cells than the slivers do.
  std::size_t by_boxes = 0;
  tree.visit([&](const Octree::Visited& visited) {
    if (!visited.is_leaf) return;
    for (std::size_t i = 0; i < mesh.size(); ++i) by_boxes += mesh.bounds(i).intersection(visited.cell).is_empty() ? 0 : 1;
  });
  EXPECT_LT(tree.references.size(), by_boxes / 2);
}

TEST(Octree, CutsCubesInTheMiddle) {
  const TriangleMesh mesh = testing::pebbles(5000, 0.05F, 5);
  const Octree tree = build_octree(mesh, {});
  std::size_t wrong = 0;
  tree.visit([&](const Octree::Visited& visited) {
    const Vec3 side = visited.cell.extent();
    wrong += std::fabs(side.x - side.y) > 1e-5F || std::fabs(side.x - side.z) > 1e-5F ? 1 : 0;
    if (visited.is_leaf) return;
    for (int axis = 0; axis < 3; ++axis) wrong += tree.nodes[visited.node].planes[axis] != visited.cell.centre()[axis] ? 1 : 0;
  });
  EXPECT_EQ(wrong, 0U);
}

// Where a set is larger than a leaf may be and the cell not too small, it is cut: nothing is left together for want of trying.
TEST(Octree, IsCutUntilLeafSizeOrMaxDepth) {
  const TriangleMesh mesh = testing::pebbles(20000, 0.01F, 6);
  const Octree tree = build_octree(mesh, {.most_depth = 6, .leaf_size = 5, .most_references = 1e4});
  std::size_t wrong = 0;
  tree.visit([&](const Octree::Visited& visited) { wrong += visited.is_leaf && visited.count > 5 && visited.depth < 6 ? 1 : 0; });
  EXPECT_EQ(wrong, 0U);
  EXPECT_EQ(tree.depth, 6U);
}

TEST(Octree, KeepsEachPrimitiveInTheSmallestNodeThatEnclosesIt) {
  const TriangleMesh mesh = testing::pebbles(5000, 0.02F, 7);
  const Octree tree = build_octree(mesh, {.store = OctreeStore::inner});
  std::vector<int> references(mesh.size(), 0);
  std::size_t wrong = 0;
  std::map<std::uint32_t, Box> cells;
  tree.visit([&](const Octree::Visited& visited) {
    if (!visited.is_leaf) cells[visited.node] = visited.cell;
    for (std::uint32_t i = visited.first; i < visited.first + visited.count; ++i) {
      const std::uint32_t id = tree.references[i];
      ++references[id];
      const Box bounds = mesh.bounds(id);
      wrong += visited.cell.contains(bounds) ? 0 : 1;
      // A node's own: no octant of it has them whole.
      const OctreeNode& node = tree.nodes[visited.node];
      if (visited.cell.lower != cells[visited.node].lower || visited.cell.upper != cells[visited.node].upper) continue;
      for (std::uint32_t octant = 0; octant < 8; ++octant) wrong += node.octant_cell(visited.cell, octant).contains(bounds) ? 1 : 0;
    }
  });
  EXPECT_EQ(wrong, 0U);
  EXPECT_EQ(tree.references.size(), mesh.size());
  EXPECT_EQ(std::count(references.begin(), references.end(), 1), static_cast<std::ptrdiff_t>(mesh.size()));
}

TEST(Octree, RefersToSpheresWhereTheirSurfaceIs) {
  std::vector<SphereSet::Sphere> spheres{{Vec3(0.0F), 1.0F}};
  Random random(8);
  for (int i = 0; i < 3000; ++i) spheres.push_back({2.0F * testing::random_point(random) - 1.0F, 0.01F});
  const SphereSet set(std::move(spheres));
  const Octree tree = build_octree(set, {});
  EXPECT_EQ(tree.validate(set.size()), "");
  std::size_t wrong = 0;
  std::size_t leaves = 0;
  std::size_t of_the_large = 0;
  tree.visit([&](const Octree::Visited& visited) {
    leaves += visited.is_leaf ? 1 : 0;
    for (std::uint32_t i = visited.first; i < visited.first + visited.count; ++i) {
      wrong += set.overlaps(tree.references[i], visited.cell) ? 0 : 1;
      of_the_large += tree.references[i] == 0 ? 1 : 0;
    }
  });
  EXPECT_EQ(wrong, 0U);
  // Cells within the large sphere do not refer to it.
  EXPECT_LT(of_the_large, leaves / 2);
}

TEST(Octree, KeepsToItsLimits) {
  const TriangleMesh mesh = testing::slivers(5000, 5);
  for (const double most : {1.0, 1.3, 3.0}) {
    const Octree tree = build_octree(mesh, {.most_references = most});
    EXPECT_LE(static_cast<double>(tree.references.size()), most * static_cast<double>(mesh.size()));
    EXPECT_EQ(tree.validate(mesh.size()), "");
  }
  for (const OctreeStore store : kStores) {
    EXPECT_LE(build_octree(mesh, {.store = store, .most_depth = 4}).depth, 4U);
    const Octree leaf = build_octree(mesh, {.store = store, .leaf_size = 5000});
    EXPECT_EQ(leaf.nodes.size(), 1U);
    EXPECT_EQ(leaf.leaf_count(), 1U);
    EXPECT_EQ(leaf.depth, 0U);
    EXPECT_EQ(leaf.validate(mesh.size()), "");
  }
}

TEST(Octree, IsWholeAndBoundedForDegenerateSets) {
  for (const auto& [name, mesh] : testing::degenerate_meshes()) {
    SCOPED_TRACE(name);
    for (const OctreeStore store : kStores) {
      const Octree tree = build_octree(mesh, {.store = store});
      ASSERT_EQ(tree.validate(mesh.size()), "");
      EXPECT_LE(tree.depth, 10U);
      const std::set<std::uint32_t> referenced(tree.references.begin(), tree.references.end());
      std::size_t hittable = 0;
      std::size_t wrong = 0;
      for (std::uint32_t i = 0; i < mesh.size(); ++i) {
        const bool can_be_hit = !mesh.bounds(i).is_empty();
        hittable += can_be_hit ? 1 : 0;
        wrong += (referenced.count(i) > 0) != can_be_hit ? 1 : 0;
      }
      EXPECT_EQ(wrong, 0U) << "are left out, or in for nothing";
      EXPECT_LE(tree.references.size(), 8 * hittable);
    }
  }
}

TEST(Octree, OfNothingIsEmpty) {
  const Octree tree = build_octree(TriangleMesh(), {});
  EXPECT_EQ(tree.validate(0), "");
  EXPECT_TRUE(tree.nodes.empty());
  EXPECT_EQ(tree.memory(), 0U);
}

bool same_octree(const Octree& a, const Octree& b) {
  return a.nodes == b.nodes && a.leaf_first == b.leaf_first && a.references == b.references && a.depth == b.depth;
}

TEST(Octree, IsTheSameForAnyNumberOfThreads) {
  // Large enough for every stage of parallel building.
  const TriangleMesh mesh = testing::pebbles(150000, 0.02F, 7);
  for (const OctreeStore store : kStores) {
    const auto build = [&] { return build_octree(mesh, {.store = store}); };
    const Octree first = testing::with_threads(1, build);
    EXPECT_EQ(first.validate(mesh.size()), "");
    for (const int threads : {2, 3, 8}) EXPECT_TRUE(same_octree(testing::with_threads(threads, build), first)) << threads << " threads";
  }
}

// Also where limits bind, where nothing parts the set, and where some primitives can never be hit.
TEST(Octree, OfMergedSubsetsIsTheSameTree) {
  std::vector<testing::NamedMesh> meshes = testing::degenerate_meshes();
  meshes.push_back({"pebbles", testing::pebbles(70000, 0.02F, 7)});
  meshes.push_back({"slivers", testing::slivers(5000, 8)});
  meshes.push_back({"a few", testing::pebbles(3, 0.2F, 9)});
  for (const auto& [name, mesh] : meshes) {
    SCOPED_TRACE(name);
    for (const OctreeStore store : kStores) {
      for (const double most : {8.0, 1.5}) {
        const Octree whole = build_octree(mesh, {.store = store, .most_references = most});
        for (const int threads : {1, 8}) {
          const auto merge = [&] { return build_octree(mesh, {.store = store, .build = OctreeBuild::merge, .most_references = most}); };
          EXPECT_TRUE(same_octree(testing::with_threads(threads, merge), whole)) << threads << " threads";
        }
      }
    }
  }
}

TEST(Octree, ValidateNamesWhatIsBroken) {
  const TriangleMesh mesh = testing::pebbles(200, 0.1F, 9);
  const Octree good = build_octree(mesh, {});
  ASSERT_EQ(good.validate(mesh.size()), "");
  const auto fault = [&](const auto& spoil) {
    Octree tree = good;
    spoil(tree);
    return tree.validate(mesh.size());
  };
  EXPECT_NE(fault([](Octree& tree) { tree.nodes[0].planes[1] = tree.cell.upper.y; }), "");
  EXPECT_NE(fault([](Octree& tree) { tree.nodes[0].first_child = 0; }), "");
  EXPECT_NE(fault([](Octree& tree) { tree.nodes[0].interior_mask = tree.nodes[0].leaf_mask = 255; }), "");
  EXPECT_NE(fault([](Octree& tree) { tree.leaf_first[1] = tree.leaf_first[2]; }), "");
  EXPECT_NE(fault([](Octree& tree) { std::swap(tree.references[0], tree.references[1]); }), "");
  EXPECT_NE(fault([](Octree& tree) { tree.references.back() = 1000; }), "");
  EXPECT_NE(fault([](Octree& tree) { ++tree.depth; }), "");
  EXPECT_NE(fault([](Octree& tree) { tree.bounds.upper.x += 10.0F; }), "");
}

}  // namespace
}  // namespace grove
