// Kd-trees after local updates: what lies in which leaf, limits of memory, references and depth, what subtrees cost, threads. Hits are checked in tests/registry.

#include <gtest/gtest.h>

#include <cstring>

#include "build/points_in_leaves.h"
#include "build/sample_meshes.h"
#include "build/threads.h"
#include "grove/build/kd_tree/update_kd_tree.h"

namespace grove {
namespace {

constexpr KdSplit kSplits[] = {KdSplit::sah, KdSplit::binned, KdSplit::object_median, KdSplit::spatial_median};

// A mesh of triangles that share no vertices, the tree over it, and what updates it.
struct Playground {
  TriangleMesh mesh;
  KdTreeSettings settings;
  KdTree tree;
  KdTreeUpdater updater;
  Random random{11};
  std::vector<std::uint32_t> changed;

  Playground(TriangleMesh triangles, const KdTreeSettings& kd_settings)
      : mesh(std::move(triangles)), settings(kd_settings), tree(build_kd_tree(mesh, kd_settings)), updater(kd_settings) {}

  std::uint32_t any() { return random.next_u32(static_cast<std::uint32_t>(mesh.size())); }
  void move(std::uint32_t i, const Vec3& by) {
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint32_t vertex = mesh.triangles()[i][corner];
      mesh.move_vertex(vertex, mesh.vertices()[vertex] + by);
    }
    changed.push_back(i);
  }
  void remove(std::uint32_t i) {
    mesh.remove_triangle(i);
    changed.push_back(i);
  }
  void add(float size) {
    const Vec3 centre = testing::random_point(random);
    std::vector<Vec3> corners;
    for (int corner = 0; corner < 3; ++corner) corners.push_back(centre + size * (testing::random_point(random) - 0.5F));
    const auto first = static_cast<std::uint32_t>(mesh.vertices().size());
    const std::vector<Triangle> triangles{{first, first + 1, first + 2}};
    changed.push_back(mesh.extend_last_part(corners, triangles));
  }
  // Returns whether the update was a local one.
  bool update(double rays) {
    const KdTreeUpdate update = updater.update(tree, mesh, changed, {.rays = rays});
    changed.clear();
    if (update.must_rebuild) {
      tree = build_kd_tree(mesh, settings);
      updater.forget();
      return false;
    }
    EXPECT_NEAR(update.cost, expected_cost(tree, settings.cost), 1e-3 * update.cost);
    return true;
  }
  [[nodiscard]] std::size_t references_in_leaves() const {
    std::size_t references = 0;
    tree.visit([&](const Box& /*cell*/, std::uint32_t /*depth*/, const KdNode& node) { references += node.is_leaf() ? node.count() : 0; });
    return references;
  }
};

TEST(KdTreeUpdater, KeepsEachPointInALeafThatRefersToIt) {
  for (const KdSplit split : kSplits) {
    for (const bool clip : {true, false}) {
      for (const double rays : {0.0, 1e7}) {
        Playground playground(testing::pebbles(1500, 0.1F, 2), {.split = split, .clip = clip});
        int local = 0;
        for (int frame = 0; frame < 12; ++frame) {
          for (int i = 0; i < 15; ++i) playground.move(playground.any(), 0.3F * (testing::random_point(playground.random) - 0.5F));
          for (int i = 0; i < 10; ++i) playground.remove(playground.any());
          for (int i = 0; i < 10; ++i) playground.add(frame == 7 ? 1.0F : 0.1F);
          local += playground.update(rays) ? 1 : 0;
          ASSERT_EQ(playground.tree.validate(playground.mesh.size()), "");
          testing::expect_points_in_their_leaves(playground.tree, playground.mesh);
          // And nothing is where it is not.
          std::vector<bool> is_referenced(playground.mesh.size(), false);
          playground.tree.visit([&](const Box& cell, std::uint32_t /*depth*/, const KdNode& node) {
            if (!node.is_leaf()) return;
            for (std::uint32_t slot = node.first(); slot < node.first() + node.count(); ++slot) {
              const std::uint32_t id = playground.tree.references[slot];
              EXPECT_FALSE(playground.mesh.bounds(id).intersection(cell).is_empty());
              is_referenced[id] = true;
            }
          });
          for (std::uint32_t i = 0; i < playground.mesh.size(); ++i) EXPECT_EQ(is_referenced[i], !playground.mesh.bounds(i).is_empty());
        }
        EXPECT_GE(local, 10);
      }
    }
  }
}

// Few changes are followed by the old boxes, many by looking into every leaf: the leaves come out the same.
TEST(KdTreeUpdater, FindsTheSameLeavesEitherWay) {
  Playground few(testing::pebbles(3000, 0.1F, 3), {});
  Playground many(testing::pebbles(3000, 0.1F, 3), {});
  for (Playground* playground : {&few, &many}) {
    playground->move(0, Vec3(0.0F));  // learns the boxes
    EXPECT_TRUE(playground->update(0.0));
    for (std::uint32_t i = 0; i < 40; ++i) playground->move(7 * i, Vec3(0.2F, -0.1F, 0.1F));
  }
  // Those that are named but stay where they were.
  for (std::uint32_t i = 0; i < 500; ++i) many.changed.push_back(0);
  EXPECT_TRUE(few.update(0.0));
  EXPECT_TRUE(many.update(0.0));
  EXPECT_EQ(few.tree.references, many.tree.references);
  EXPECT_EQ(std::memcmp(few.tree.nodes.data(), many.tree.nodes.data(), few.tree.nodes.size() * sizeof(KdNode)), 0);
}

TEST(KdTreeUpdater, KeepsCloseToATreeBuiltAnew) {
  for (const double rays : {0.0, 1e6}) {
    Playground playground(testing::pebbles(10000, 0.03F, 4), {});
    for (int frame = 0; frame < 20; ++frame) {
      for (int i = 0; i < 500; ++i) playground.move(playground.any(), 0.3F * (testing::random_point(playground.random) - 0.5F));
      playground.update(rays);
    }
    const double anew = expected_cost(build_kd_tree(playground.mesh, {}), {});
    EXPECT_LT(expected_cost(playground.tree, {}), (rays > 0.0 ? 1.4 : 1.6) * anew);
  }
}

TEST(KdTreeUpdater, RebuildsWhatHasBecomeDear) {
  Playground playground(testing::pebbles(20000, 0.01F, 5), {});
  // What is near one side is crowded together there, and then spreads.
  for (const float scale : {0.1F, 10.0F}) {
    for (std::uint32_t i = 0; i < playground.mesh.size(); ++i) {
      const Vec3 corner = playground.mesh.vertices()[playground.mesh.triangles()[i].x];
      if (corner.x < 0.2F) playground.move(i, Vec3(1.0F, scale, scale) * corner - corner);
    }
    if (scale > 1.0F) break;
    playground.changed.clear();
    playground.tree = build_kd_tree(playground.mesh, {});
    playground.move(0, Vec3(0.0F));
    ASSERT_TRUE(playground.update(0.0));
  }
  const std::vector<std::uint32_t> changed = playground.changed;
  KdTree left = playground.tree;
  KdTreeUpdater without = playground.updater;
  const KdTreeUpdate lazy = without.update(left, playground.mesh, changed, {.rays = 0.0});
  const KdTreeUpdate keen = playground.updater.update(playground.tree, playground.mesh, changed, {.rays = 1e6});
  ASSERT_FALSE(lazy.must_rebuild || keen.must_rebuild);
  EXPECT_EQ(lazy.rebuilt_references, 0U);
  EXPECT_GT(keen.rebuilt_references, 256U);
  EXPECT_LT(keen.cost, lazy.cost);
  EXPECT_EQ(playground.tree.validate(playground.mesh.size()), "");
  testing::expect_points_in_their_leaves(playground.tree, playground.mesh);
  // The more rays, the more of it.
  KdTreeUpdate most = without.update(left, playground.mesh, changed, {.rays = 1e12});
  EXPECT_TRUE(most.must_rebuild || most.rebuilt_references > keen.rebuilt_references);
}

TEST(KdTreeUpdater, KeepsToItsLimits) {
  // All comes and goes many times over.
  Playground playground(testing::slivers(1000, 6), {.most_depth = 20});
  for (int frame = 0; frame < 150; ++frame) {
    for (int i = 0; i < 30; ++i) playground.move(playground.any(), 0.5F * (testing::random_point(playground.random) - 0.5F));
    playground.update(0.0);
    const KdTree& tree = playground.tree;
    ASSERT_EQ(tree.validate(playground.mesh.size()), "");
    ASSERT_LE(tree.depth, 20U);
    const std::size_t used = playground.references_in_leaves();
    ASSERT_LE(used, 8U * 1000U);
    ASSERT_LE(tree.references.size(), used + used / 2 + 512);
    std::size_t nodes = 2;
    tree.visit([&](const Box& /*cell*/, std::uint32_t /*depth*/, const KdNode& node) { nodes += node.is_leaf() ? 0 : 2; });
    ASSERT_LE(tree.nodes.size(), nodes + nodes / 2 + 1024);
  }
}

TEST(KdTreeUpdater, GivesUpWhereReferencesWouldBeTooMany) {
  Playground playground(testing::pebbles(5000, 0.02F, 7), {});
  for (int i = 0; i < 1000; ++i) playground.add(3.0F);  // reach into nearly all cells
  EXPECT_FALSE(playground.update(0.0));
  EXPECT_LE(playground.references_in_leaves(), 8U * playground.mesh.size());
}

TEST(KdTreeUpdater, MergesLeavesThatHaveBecomeEmpty) {
  Playground playground(testing::pebbles(4000, 0.02F, 8), {});
  const std::size_t before = playground.tree.nodes.size();
  for (std::uint32_t i = 0; i + 10 < playground.mesh.size(); ++i) {
    playground.remove(i);
    if (playground.changed.size() == 200) {
      ASSERT_TRUE(playground.update(0.0));
    }
  }
  playground.update(0.0);
  EXPECT_EQ(playground.tree.validate(playground.mesh.size()), "");
  EXPECT_LT(playground.tree.nodes.size(), before / 5);
  EXPECT_LT(playground.tree.depth, 12U);
  for (std::uint32_t i = 0; i < playground.mesh.size(); ++i) playground.remove(i);
  EXPECT_FALSE(playground.update(0.0)) << "nothing is left";
  EXPECT_TRUE(playground.tree.nodes.empty());
}

// As many as several tasks part.
TEST(KdTreeUpdater, PartsALeafThatGetsManyAtOnce) {
  for (const KdSplit split : kSplits) {
    Playground playground(testing::pebbles(2, 1.0F, 12), {.split = split});
    for (int i = 0; i < 9000; ++i) playground.add(0.05F);
    ASSERT_TRUE(playground.update(0.0));
    EXPECT_EQ(playground.tree.validate(playground.mesh.size()), "");
    const double anew = expected_cost(build_kd_tree(playground.mesh, playground.settings), {});
    EXPECT_LT(expected_cost(playground.tree, {}), 1.2 * anew);
  }
}

TEST(KdTreeUpdater, GrowsWithWhatComesFromOutside) {
  Playground playground(testing::pebbles(2000, 0.05F, 9), {});
  playground.move(5, Vec3(0.2F, 0.0F, 0.0F));
  playground.move(6, Vec3(0.0F, -0.2F, 0.4F));
  EXPECT_TRUE(playground.update(1e6));
  testing::expect_points_in_their_leaves(playground.tree, playground.mesh);
  playground.move(7, Vec3(100.0F));
  EXPECT_FALSE(playground.update(1e6)) << "nearly all of the root's cell would be empty";
}

TEST(KdTreeUpdater, IsTheSameForAnyNumberOfThreads) {
  KdTree first;
  for (const int threads : {1, 2, 3, 8}) {
    Playground playground(testing::pebbles(40000, 0.02F, 10), {});
    testing::with_threads(threads, [&] {
      for (int frame = 0; frame < 3; ++frame) {
        for (int i = 0; i < (frame == 0 ? 300 : 5000); ++i)
          playground.move(playground.any(), 0.2F * testing::random_point(playground.random));
        EXPECT_TRUE(playground.update(frame == 2 ? 3e5 : 0.0));
      }
      return 0;
    });
    if (threads == 1) {
      first = playground.tree;
      continue;
    }
    EXPECT_EQ(playground.tree.references, first.references) << threads << " threads";
    ASSERT_EQ(playground.tree.nodes.size(), first.nodes.size());
    EXPECT_EQ(std::memcmp(playground.tree.nodes.data(), first.nodes.data(), first.nodes.size() * sizeof(KdNode)), 0)
        << threads << " threads";
  }
}

}  // namespace
}  // namespace grove
