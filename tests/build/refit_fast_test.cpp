#include "grove/build/fast/refit_fast.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

#include "build/sample_meshes.h"
#include "build/threads.h"
#include "grove/build/fast/pack_fast.h"
#include "grove/build/passes/collapse_settings.h"
#include "grove/build/top_down.h"

namespace grove {
namespace {

constexpr std::size_t kCount = 20000;

template <typename Bvh>
Bvh packed(const TriangleMesh& mesh) {
  CollapseSettings settings;
  settings.leaf_size = TriangleBlock::kWidth;
  settings.cost.block_size = TriangleBlock::kWidth;
  return pack_fast<Bvh>(build_top_down(list_references(mesh), {.leaf_size = 1}), mesh, settings);
}

// Turns and stretches a mesh, so that every plane moves.
void move(TriangleMesh& mesh) {
  std::vector<Vec3> vertices(mesh.vertices().begin(), mesh.vertices().end());
  for (Vec3& v : vertices) v = {3.0F * v.y + 0.5F * v.x, v.z - v.x, 2.0F * v.x + v.y};
  mesh.move_vertices(vertices);
}

bool same(const Box& a, const Box& b) {
  return a.lower == b.lower && a.upper == b.upper;
}

template <typename Bvh>
bool same(const Bvh& a, const Bvh& b) {
  return same(a.bounds, b.bounds) && a.memory() == b.memory() && std::memcmp(a.units(), b.units(), a.memory()) == 0;
}

template <typename Bvh>
class RefitFast : public ::testing::Test {};
using Formats = ::testing::Types<FastBvh, CompressedFastBvh>;
TYPED_TEST_SUITE(RefitFast, Formats);

// The bounds of all triangles below a child.
template <typename Bvh>
Box bounds_below(const Bvh& bvh, const TriangleMesh& mesh, typename Bvh::Child child) {
  Box box;
  if (child.is_leaf()) {
    for (const std::uint32_t primitive : bvh.block(child).primitive) box.grow(mesh.bounds(primitive));
    return box;
  }
  const auto& node = bvh.nodes()[child.node()];
  for (int place = 0; place < Bvh::Node::kWidth; ++place)
    if (node.has_child(place)) box.grow(bounds_below(bvh, mesh, node.child[place]));
  return box;
}

// Node n has the children and orders that it had before, and the boxes of their triangles as its format has them.
template <typename Bvh>
void expect_refitted(const Bvh& bvh, const Bvh& before, const TriangleMesh& mesh, std::size_t n) {
  const auto& node = bvh.nodes()[n];
  const auto& old = before.nodes()[n];
  EXPECT_EQ(std::memcmp(node.child, old.child, sizeof node.child), 0) << n;
  std::uint32_t orders[8];
  for (unsigned octant = 0; octant < 8; ++octant) {
    orders[octant] = node.order_for(octant);
    EXPECT_EQ(orders[octant] & 0xffffffU, old.order_for(octant) & 0xffffffU);
  }
  EightBoxes boxes;
  int count = 0;
  for (int place = 0; place < Bvh::Node::kWidth; ++place) {
    ASSERT_EQ(node.has_child(place), old.has_child(place)) << n;
    Box box;
    if (node.has_child(place)) {
      box = bounds_below(bvh, mesh, node.child[place]);
      ++count;
    }
    for (int axis = 0; axis < 3; ++axis) {
      boxes.planes[axis][0][place] = box.lower[axis];
      boxes.planes[axis][1][place] = box.upper[axis];
    }
  }
  typename Bvh::Node expected;
  expected.set(boxes, count, orders);
  for (int place = 0; place < count; ++place) EXPECT_TRUE(same(node.child_box(place), expected.child_box(place))) << n << ", " << place;
}

TYPED_TEST(RefitFast, MeasuresBoxesAndCornersAnew) {
  for (const std::size_t count : {std::size_t{1}, std::size_t{5}, kCount}) {
    TriangleMesh mesh = testing::pebbles(count, 0.05F, 3);
    auto bvh = packed<TypeParam>(mesh);
    const auto before = bvh;
    move(mesh);
    const FastRefit refitted = refit_fast(bvh, mesh);
    EXPECT_TRUE(refitted.all_hittable);
    EXPECT_EQ(bvh.validate(count, mesh.vertices()), "") << count;
    const double cost = expected_cost(bvh, CostModel{});
    // Boxes on grids may stick out of those above them, where no ray comes.
    EXPECT_NEAR(refitted.cost, cost, (std::is_same_v<TypeParam, FastBvh> ? 1e-6 : 1e-2) * cost) << count;
    EXPECT_TRUE(same(bvh.bounds, bounds_below(bvh, mesh, TypeParam::Child::node(0))));
    ASSERT_EQ(bvh.nodes().size(), before.nodes().size());
    for (std::size_t n = 0; n < bvh.nodes().size(); ++n) expect_refitted(bvh, before, mesh, n);
    for (const auto& block : bvh.blocks()) {
      const TriangleBlock& triangles = gathered(block, mesh.vertices().data());
      for (std::uint32_t place = 0; place < TriangleBlock::kWidth; ++place)
        for (int corner = 0; corner < 3; ++corner)
          for (int axis = 0; axis < 3; ++axis)
            ASSERT_EQ(triangles.corners[axis][corner][place], mesh.vertices()[mesh.triangles()[block.primitive[place]][corner]][axis]);
    }
  }
}

TYPED_TEST(RefitFast, IsTheSameForAnyNumberOfThreads) {
  TriangleMesh mesh = testing::pebbles(kCount, 0.05F, 4);
  const auto before = packed<TypeParam>(mesh);
  move(mesh);
  auto first = before;
  const double first_cost = testing::with_threads(1, [&] { return refit_fast(first, mesh).cost; });
  for (const int threads : {3, 8}) {
    auto other = before;
    EXPECT_EQ(testing::with_threads(threads, [&] { return refit_fast(other, mesh).cost; }), first_cost);
    EXPECT_TRUE(same(other, first)) << threads;
  }
}

TYPED_TEST(RefitFast, TellsOfTrianglesThatCannotBeHit) {
  TriangleMesh mesh = testing::pebbles(100, 0.05F, 5);
  auto bvh = packed<TypeParam>(mesh);
  std::vector<Vec3> vertices(mesh.vertices().begin(), mesh.vertices().end());
  vertices[17].y = std::numeric_limits<float>::quiet_NaN();
  mesh.move_vertices(vertices);
  EXPECT_FALSE(refit_fast(bvh, mesh).all_hittable);
  TypeParam empty;
  EXPECT_EQ(refit_fast(empty, mesh).cost, 0.0);
}

}  // namespace
}  // namespace grove
