#include "grove/build/fast/pack_fast.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "build/sample_meshes.h"
#include "build/threads.h"
#include "grove/build/top_down.h"

namespace grove {
namespace {

CollapseSettings by_blocks() {
  CollapseSettings settings;
  settings.leaf_size = TriangleBlock::kWidth;
  settings.cost.block_size = TriangleBlock::kWidth;
  return settings;
}

Bvh2 binary(const TriangleMesh& mesh) {
  return build_top_down(list_references(mesh), {.leaf_size = 1});
}

TEST(PackFast, KeepsEveryTriangleInABlockOfItsLeaf) {
  for (const std::size_t count : {0U, 1U, 2U, 4U, 5U, 100U, 20000U}) {
    const TriangleMesh mesh = testing::pebbles(count, 0.05F, count);
    const FastBvh bvh = pack_fast<FastBvh>(binary(mesh), mesh, by_blocks());
    ASSERT_EQ(bvh.validate(count), "") << count;
    ASSERT_EQ(bvh.references, count);
    std::vector<std::uint32_t> ids;
    for (const FastNode& node : bvh.nodes()) {
      for (int i = 0; i < FastNode::kWidth; ++i) {
        if (!node.has_child(i) || !node.child[i].is_leaf()) continue;
        const TriangleBlock& block = bvh.block(node.child[i]);
        for (std::uint32_t place = 0; place < block.count(); ++place) {
          const std::uint32_t id = block.primitive[place];
          ids.push_back(id);
          const Triangle& triangle = mesh.triangles()[id];
          const std::uint32_t vertices[3] = {triangle.x, triangle.y, triangle.z};
          for (int corner = 0; corner < 3; ++corner)
            for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(block.corners[axis][corner][place], mesh.vertices()[vertices[corner]][axis]);
        }
      }
    }
    std::sort(ids.begin(), ids.end());
    for (std::uint32_t i = 0; i < count; ++i) ASSERT_EQ(ids[i], i);
  }
}

TEST(PackFast, OrdersChildrenFromFarToNear) {
  const TriangleMesh mesh = testing::pebbles(3000, 0.05F, 2);
  const FastBvh bvh = pack_fast<FastBvh>(binary(mesh), mesh, by_blocks());
  for (const FastNode& node : bvh.nodes()) {
    for (unsigned octant = 0; octant < 8; ++octant) {
      float last = std::numeric_limits<float>::infinity();
      for (int k = 0; k < FastNode::kWidth; ++k) {
        const auto place = static_cast<int>(node.order_for(octant) >> (3 * k) & 7U);
        if (!node.has_child(place)) continue;
        const Box box = node.child_box(place);
        float along = 0.0F;
        for (int axis = 0; axis < 3; ++axis) along += ((octant >> axis & 1U) != 0 ? -0.5F : 0.5F) * (box.lower[axis] + box.upper[axis]);
        EXPECT_LE(along, last + 1e-5F);
        last = along;
      }
    }
  }
}

// Boxes on a node's grid hold the boxes that they stand for, and are larger by less than a step on each side; all else is the same.
TEST(PackFast, CompressedNodesHoldTheirChildren) {
  for (const float size : {1e-20F, 0.05F, 1e15F}) {
    const TriangleMesh unit = testing::pebbles(5000, 0.05F, 7);
    std::vector<Vec3> vertices;
    vertices.reserve(unit.vertices().size());
    for (const Vec3& vertex : unit.vertices()) vertices.push_back(vertex * size + Vec3(size, 0.0F, -3.0F * size));
    const TriangleMesh mesh(vertices, {unit.triangles().begin(), unit.triangles().end()});
    const Bvh2 from = binary(mesh);
    const auto full = pack_fast<FastBvh>(from, mesh, by_blocks());
    const auto compressed = pack_fast<CompressedFastBvh>(from, mesh, by_blocks());
    ASSERT_EQ(compressed.validate(mesh.size(), mesh.vertices()), "");
    ASSERT_EQ(compressed.nodes().size(), full.nodes().size());
    EXPECT_EQ(compressed.references, full.references);
    EXPECT_LT(compressed.memory(), full.memory() / 2);
    for (std::size_t number = 0; number < full.nodes().size(); ++number) {
      const FastNode& whole = full.nodes()[number];
      const CompressedNode& small = compressed.nodes()[number];
      for (std::uint32_t octant = 0; octant < 8; ++octant) EXPECT_EQ(small.order_for(octant) & 0xffffffU, whole.order_for(octant));
      for (int i = 0; i < FastNode::kWidth; ++i) {
        ASSERT_EQ(small.has_child(i), whole.has_child(i));
        EXPECT_EQ(small.child_box(i).is_empty(), !small.has_child(i));
        if (!small.has_child(i)) continue;
        EXPECT_EQ(small.child[i].is_leaf(), whole.child[i].is_leaf());
        const Box box = whole.child_box(i);
        EXPECT_TRUE(small.child_box(i).contains(box));
        const Box loose = small.child_box(i);
        for (int axis = 0; axis < 3; ++axis) {
          EXPECT_LE(box.lower[axis] - loose.lower[axis], 1.01F * small.scale_along(axis));
          EXPECT_LE(loose.upper[axis] - box.upper[axis], 1.01F * small.scale_along(axis));
        }
      }
    }
  }
}

TEST(PackFast, DoesNotDependOnTheThreads) {
  const TriangleMesh mesh = testing::pebbles(50000, 0.01F, 3);
  const Bvh2 from = binary(mesh);
  const FastBvh one = testing::with_threads(1, [&] { return pack_fast<FastBvh>(from, mesh, by_blocks()); });
  for (const int threads : {2, 3, 8}) {
    const FastBvh many = testing::with_threads(threads, [&] { return pack_fast<FastBvh>(from, mesh, by_blocks()); });
    ASSERT_EQ(many.nodes().size(), one.nodes().size());
    ASSERT_EQ(many.blocks().size(), one.blocks().size());
    EXPECT_EQ(std::memcmp(many.nodes().data(), one.nodes().data(), one.nodes().size() * sizeof(FastNode)), 0);
    EXPECT_EQ(std::memcmp(many.blocks().data(), one.blocks().data(), one.blocks().size() * sizeof(TriangleBlock)), 0);
  }
}

// A block that takes the same time however full it is is filled where it can be.
TEST(PackFast, LeavesAreFullerWhereABlockTakesTheSameTime) {
  const TriangleMesh mesh = testing::pebbles(20000, 0.05F, 4);
  const Bvh2 from = binary(mesh);
  CollapseSettings settings = by_blocks();
  settings.cost.intersection = 0.25;
  const std::size_t filled = pack_fast<FastBvh>(from, mesh, settings).blocks().size();
  settings.cost.block_size = 1;
  EXPECT_LT(filled, pack_fast<FastBvh>(from, mesh, settings).blocks().size());
}

}  // namespace
}  // namespace grove
