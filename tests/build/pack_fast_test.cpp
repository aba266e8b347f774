#include "grove/build/fast/pack_fast.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "build/sample_meshes.h"
#include "build/threads.h"
#include "grove/build/passes/collapse.h"
#include "grove/build/top_down.h"

namespace grove {
namespace {

WideBvh<8> wide(const TriangleMesh& mesh) {
  CollapseSettings settings;
  settings.arity = 8;
  settings.leaf_size = TriangleBlock::kWidth;
  settings.block_size = TriangleBlock::kWidth;
  return widen<8>(build_top_down(list_references(mesh), {.leaf_size = 1}), settings);
}

TEST(PackFast, KeepsEveryTriangleInABlockOfItsLeaf) {
  for (const std::size_t count : {0U, 1U, 2U, 4U, 5U, 100U, 20000U}) {
    const TriangleMesh mesh = testing::pebbles(count, 0.05F, count);
    const WideBvh<8> from = wide(mesh);
    const FastBvh bvh = pack_fast(from, mesh);
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
  const FastBvh bvh = pack_fast(wide(testing::pebbles(3000, 0.05F, 2)), testing::pebbles(3000, 0.05F, 2));
  for (const FastNode& node : bvh.nodes()) {
    for (unsigned octant = 0; octant < 8; ++octant) {
      float last = std::numeric_limits<float>::infinity();
      for (int k = 0; k < FastNode::kWidth; ++k) {
        const auto place = static_cast<int>(node.order[octant] >> (3 * k) & 7U);
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

TEST(PackFast, DoesNotDependOnTheThreads) {
  const TriangleMesh mesh = testing::pebbles(50000, 0.01F, 3);
  const WideBvh<8> from = wide(mesh);
  const FastBvh one = testing::with_threads(1, [&] { return pack_fast(from, mesh); });
  for (const int threads : {2, 3, 8}) {
    const FastBvh many = testing::with_threads(threads, [&] { return pack_fast(from, mesh); });
    ASSERT_EQ(many.nodes().size(), one.nodes().size());
    ASSERT_EQ(many.blocks().size(), one.blocks().size());
    EXPECT_EQ(std::memcmp(many.nodes().data(), one.nodes().data(), one.nodes().size() * sizeof(FastNode)), 0);
    EXPECT_EQ(std::memcmp(many.blocks().data(), one.blocks().data(), one.blocks().size() * sizeof(TriangleBlock)), 0);
  }
}

// A block that takes the same time however full it is is filled where it can be.
TEST(PackFast, LeavesAreFullerWhereABlockTakesTheSameTime) {
  const TriangleMesh mesh = testing::pebbles(20000, 0.05F, 4);
  const Bvh2 binary = build_top_down(list_references(mesh), {.leaf_size = 1});
  CollapseSettings settings;
  settings.arity = 8;
  settings.leaf_size = TriangleBlock::kWidth;
  settings.cost.intersection = 0.25;
  const std::size_t one_by_one = pack_fast(widen<8>(binary, settings), mesh).blocks().size();
  settings.block_size = TriangleBlock::kWidth;
  EXPECT_LT(pack_fast(widen<8>(binary, settings), mesh).blocks().size(), one_by_one);
}

}  // namespace
}  // namespace grove
