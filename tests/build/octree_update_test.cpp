// Octrees that follow primitives which are added, removed and moved, without being built anew.

#include <gtest/gtest.h>

#include <numeric>

#include "build/sample_meshes.h"
#include "build/threads.h"
#include "grove/build/octree/build_octree.h"
#include "grove/build/octree/update_octree.h"

namespace grove {
namespace {

constexpr OctreeStore kStores[] = {OctreeStore::leaf, OctreeStore::inner};

bool same_octree(const Octree& a, const Octree& b) {
  return a.nodes == b.nodes && a.leaf_first == b.leaf_first && a.references == b.references && a.depth == b.depth &&
         a.cell.lower == b.cell.lower && a.cell.upper == b.cell.upper;
}

// Triangles that can be moved, hidden (not a number: they can not be hit) and shown again. The first two hold the bounds.
struct Crowd {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  std::vector<Vec3> shown;

  Crowd(std::size_t count, std::uint64_t seed) {
    const TriangleMesh mesh = testing::pebbles(count, 0.04F, seed);
    vertices.assign(mesh.vertices().begin(), mesh.vertices().end());
    triangles.assign(mesh.triangles().begin(), mesh.triangles().end());
    for (int corner = 0; corner < 3; ++corner) {
      vertices[static_cast<std::size_t>(corner)] = Vec3(-0.1F) + 0.001F * static_cast<float>(corner);
      vertices[static_cast<std::size_t>(3 + corner)] = Vec3(1.1F) - 0.001F * static_cast<float>(corner);
    }
    shown = vertices;
  }
  [[nodiscard]] TriangleMesh mesh() const { return {vertices, triangles}; }
  void move(std::uint32_t id, const Vec3& by) {
    for (int corner = 0; corner < 3; ++corner) vertices[triangles[id][corner]] += by;
  }
  void hide(std::uint32_t id) { vertices[triangles[id].x].x = std::numeric_limits<float>::quiet_NaN(); }
  void show(std::uint32_t id) {
    for (int corner = 0; corner < 3; ++corner) vertices[triangles[id][corner]] = shown[triangles[id][corner]];
  }
};

// Ids of at most `count` primitives, but the first two.
std::vector<std::uint32_t> choose(Random& random, std::size_t size, std::size_t count) {
  std::vector<std::uint32_t> ids;
  for (std::size_t i = 0; i < count; ++i) ids.push_back(2 + random.next_u32(static_cast<std::uint32_t>(size - 2)));
  return ids;
}

// Wherever the limit of references is far, the tree is that of building anew.
TEST(OctreeUpdate, GivesTheTreeOfBuildingAnew) {
  for (const OctreeStore store : kStores) {
    for (const std::size_t how_many : {1U, 40U, 1000U, 4000U}) {
      const OctreeSettings settings{.store = store, .most_depth = 7, .most_references = 1e4};
      Crowd crowd(4000, 5);
      Octree tree = build_octree(crowd.mesh(), settings);
      Random random(how_many);
      for (int step = 0; step < 6; ++step) {
        const std::vector<std::uint32_t> changed = choose(random, 4000, how_many);
        for (const std::uint32_t id : changed) {
          if (step % 3 == 0) crowd.move(id, 0.2F * (testing::random_point(random) - Vec3(0.5F)));
          if (step % 3 == 1) crowd.hide(id);
          if (step % 3 == 2) crowd.show(id);
        }
        // None may come to lie beyond the two that hold the bounds.
        for (const std::uint32_t id : changed)
          if (!Box{Vec3(-0.1F), Vec3(1.1F)}.contains(crowd.mesh().bounds(id))) crowd.show(id);
        const TriangleMesh mesh = crowd.mesh();
        const auto updated = update_octree(tree, mesh, settings, changed);
        ASSERT_TRUE(updated.has_value());
        ASSERT_EQ(updated->validate(mesh.size()), "");
        EXPECT_TRUE(same_octree(*updated, build_octree(mesh, settings))) << how_many << " changed, step " << step;
        tree = *updated;
      }
    }
  }
}

TEST(OctreeUpdate, KeepsPlanesOfOctreeR) {
  const OctreeSettings settings{.split = OctreeSplit::octree_r};
  Crowd crowd(4000, 6);
  const Octree tree = build_octree(crowd.mesh(), settings);
  Random random(7);
  const std::vector<std::uint32_t> changed = choose(random, 4000, 30);
  for (const std::uint32_t id : changed) crowd.move(id, 0.05F * testing::random_point(random));
  const TriangleMesh mesh = crowd.mesh();
  const auto updated = update_octree(tree, mesh, settings, changed);
  ASSERT_TRUE(updated.has_value());
  EXPECT_EQ(updated->validate(mesh.size()), "");
  for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(updated->nodes[0].planes[axis], tree.nodes[0].planes[axis]);
  // Each point of what has moved lies in a cell that refers to it.
  std::size_t lost = 0;
  for (const std::uint32_t id : changed) {
    for (int sample = 0; sample < 20; ++sample) {
      const Vec3 p(mesh.surface_point(id, random.next_float(), random.next_float()));
      const Box around{p - Vec3(1e-6F), p + Vec3(1e-6F)};
      bool is_found = false;
      updated->visit([&](const Octree::Visited& visited) {
        if (is_found || !visited.is_leaf || visited.cell.intersection(around).is_empty()) return;
        const auto first = updated->references.begin() + visited.first;
        is_found = std::binary_search(first, first + visited.count, id);
      });
      lost += is_found ? 0 : 1;
    }
  }
  EXPECT_EQ(lost, 0U);
}

TEST(OctreeUpdate, FollowsALittleBeyondTheBounds) {
  for (const OctreeSplit split : {OctreeSplit::median, OctreeSplit::octree_r}) {
    Crowd crowd(300, 8);
    const OctreeSettings settings{.split = split};
    const Octree tree = build_octree(crowd.mesh(), settings);
    // The one that holds the upper end of the bounds.
    const std::uint32_t id = 1;
    crowd.move(id, Vec3(0.01F));
    const TriangleMesh mesh = crowd.mesh();
    const auto updated = update_octree(tree, mesh, settings, std::span(&id, 1));
    ASSERT_TRUE(updated.has_value());
    EXPECT_EQ(updated->validate(mesh.size()), "");
    EXPECT_TRUE(updated->bounds.contains(mesh.bounds(id)));
  }
}

TEST(OctreeUpdate, AsksForANewTreeWhereTheRootDoesNotFit) {
  Crowd crowd(300, 8);
  const Octree tree = build_octree(crowd.mesh(), {});
  const std::uint32_t id = 10;
  crowd.move(id, Vec3(5.0F, 0.0F, 0.0F));
  EXPECT_FALSE(update_octree(tree, crowd.mesh(), {}, std::span(&id, 1)).has_value());
  // And where everything has shrunk.
  for (Vec3& vertex : crowd.vertices) vertex *= 0.1F;
  std::vector<std::uint32_t> all(300);
  std::iota(all.begin(), all.end(), 0U);
  EXPECT_FALSE(update_octree(tree, crowd.mesh(), {}, all).has_value());
  EXPECT_FALSE(update_octree(Octree(), crowd.mesh(), {}, all).has_value());
  EXPECT_FALSE(update_octree(tree, TriangleMesh(), {}, all).has_value());
}

// What is added to one place again and again does not make more references than may be.
TEST(OctreeUpdate, KeepsToItsLimits) {
  const OctreeSettings settings{.most_references = 3.0};
  Crowd crowd(2000, 9);
  Octree tree = build_octree(crowd.mesh(), settings);
  std::vector<std::uint32_t> changed;
  for (std::uint32_t id = 2; id < 2000; ++id) {
    for (int corner = 0; corner < 3; ++corner)
      crowd.vertices[crowd.triangles[id][corner]] = 0.5F + 0.4F * Vec3(corner == 0 ? 1 : 0, corner == 1 ? 1 : 0, corner == 2 ? 1 : 0);
    changed.push_back(id);
    if (changed.size() < 400) continue;
    const TriangleMesh mesh = crowd.mesh();
    auto updated = update_octree(tree, mesh, settings, changed);
    if (updated.has_value()) {
      EXPECT_EQ(updated->validate(mesh.size()), "");
      EXPECT_LE(updated->references.size(), 3 * mesh.size());
    }
    tree = updated.has_value() ? *std::move(updated) : build_octree(mesh, settings);
    changed.clear();
  }
}

TEST(OctreeUpdate, IsTheSameForAnyNumberOfThreads) {
  Crowd crowd(100000, 10);
  for (const OctreeStore store : kStores) {
    const OctreeSettings settings{.store = store};
    const Octree tree = build_octree(crowd.mesh(), settings);
    Random random(11);
    const std::vector<std::uint32_t> changed = choose(random, 100000, 5000);
    for (const std::uint32_t id : changed) crowd.move(id, 0.02F * (testing::random_point(random) - Vec3(0.5F)));
    const TriangleMesh mesh = crowd.mesh();
    const auto update = [&] { return update_octree(tree, mesh, settings, changed).value_or(Octree()); };
    const Octree first = testing::with_threads(1, update);
    EXPECT_EQ(first.validate(mesh.size()), "");
    EXPECT_FALSE(first.nodes.empty());
    for (const int threads : {2, 8}) EXPECT_TRUE(same_octree(testing::with_threads(threads, update), first)) << threads << " threads";
  }
}

}  // namespace
}  // namespace grove
