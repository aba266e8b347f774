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
#include "grove/build/passes/collapse.h"
#include "grove/build/passes/refit.h"
#include "grove/build/top_down.h"

namespace grove {
namespace {

constexpr std::size_t kCount = 20000;

WideBvh<8> wide(const TriangleMesh& mesh) {
  CollapseSettings settings;
  settings.arity = 8;
  settings.leaf_size = TriangleBlock::kWidth;
  settings.cost.block_size = TriangleBlock::kWidth;
  return widen<8>(build_top_down(list_references(mesh), {.leaf_size = 1}), settings);
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

// Children of node n have the boxes and triangles of those of `expected`, which may stand in other places, and the orders that they had before.
template <typename Bvh>
void expect_same_children(const Bvh& bvh, const Bvh& before, const Bvh& expected, std::size_t n) {
  const auto& node = bvh.nodes()[n];
  const auto& other = expected.nodes()[n];
  for (int place = 0; place < Bvh::Node::kWidth; ++place) {
    ASSERT_EQ(node.has_child(place), other.has_child(place)) << n;
    if (!node.has_child(place)) continue;
    const auto child = node.child[place];
    const auto is_same = [&](int k) {
      if (!other.has_child(k) || other.child[k].is_leaf() != child.is_leaf()) return false;
      if (!child.is_leaf()) return other.child[k].node() == child.node();
      return std::memcmp(&bvh.block(child), &expected.block(other.child[k]), sizeof(typename Bvh::Block)) == 0;
    };
    int found = 0;
    while (found < Bvh::Node::kWidth && !is_same(found)) ++found;
    ASSERT_LT(found, Bvh::Node::kWidth) << n << ", " << place;
    EXPECT_TRUE(same(node.child_box(place), other.child_box(found))) << n << ", " << place;
  }
  for (unsigned octant = 0; octant < 8; ++octant)
    EXPECT_EQ(node.order_for(octant) & 0xffffffU, before.nodes()[n].order_for(octant) & 0xffffffU);
}

// What another pass makes of the hierarchy that was packed, packed anew, but for the order of children.
TYPED_TEST(RefitFast, MeasuresBoxesAndCornersAnew) {
  for (const std::size_t count : {std::size_t{1}, std::size_t{5}, kCount}) {
    TriangleMesh mesh = testing::pebbles(count, 0.05F, 3);
    WideBvh<8> from = wide(mesh);
    auto bvh = pack_fast<TypeParam>(from, mesh);
    const auto before = bvh;
    move(mesh);
    const FastRefit refitted = refit_fast(bvh, mesh);
    EXPECT_TRUE(refitted.all_hittable);
    EXPECT_EQ(bvh.validate(count, mesh.vertices()), "") << count;
    const double cost = expected_cost(bvh, CostModel{});
    // Boxes on grids may stick out of those above them, where no ray comes.
    EXPECT_NEAR(refitted.cost, cost, (std::is_same_v<TypeParam, FastBvh> ? 1e-6 : 1e-2) * cost) << count;
    const auto leaf_bounds = [&](std::uint32_t first, std::uint32_t size) {
      Box box;
      for (std::uint32_t i = first; i < first + size; ++i) box.grow(mesh.bounds(from.references[i]));
      return Box4{{box.lower.x, box.lower.y, box.lower.z, 0.0F}, {box.upper.x, box.upper.y, box.upper.z, 0.0F}};
    };
    static_cast<void>(refit(from, leaf_bounds));
    const auto expected = pack_fast<TypeParam>(from, mesh);
    EXPECT_TRUE(same(bvh.bounds, expected.bounds));
    ASSERT_EQ(bvh.nodes().size(), expected.nodes().size());
    for (std::size_t n = 0; n < bvh.nodes().size(); ++n) expect_same_children(bvh, before, expected, n);
    ASSERT_EQ(bvh.blocks().size(), expected.blocks().size());
  }
}

TYPED_TEST(RefitFast, IsTheSameForAnyNumberOfThreads) {
  TriangleMesh mesh = testing::pebbles(kCount, 0.05F, 4);
  const auto packed = pack_fast<TypeParam>(wide(mesh), mesh);
  move(mesh);
  auto first = packed;
  const double first_cost = testing::with_threads(1, [&] { return refit_fast(first, mesh).cost; });
  for (const int threads : {3, 8}) {
    auto other = packed;
    EXPECT_EQ(testing::with_threads(threads, [&] { return refit_fast(other, mesh).cost; }), first_cost);
    EXPECT_TRUE(same(other, first)) << threads;
  }
}

TYPED_TEST(RefitFast, TellsOfTrianglesThatCannotBeHit) {
  TriangleMesh mesh = testing::pebbles(100, 0.05F, 5);
  auto bvh = pack_fast<TypeParam>(wide(mesh), mesh);
  std::vector<Vec3> vertices(mesh.vertices().begin(), mesh.vertices().end());
  vertices[17].y = std::numeric_limits<float>::quiet_NaN();
  mesh.move_vertices(vertices);
  EXPECT_FALSE(refit_fast(bvh, mesh).all_hittable);
  TypeParam empty;
  EXPECT_EQ(refit_fast(empty, mesh).cost, 0.0);
}

}  // namespace
}  // namespace grove
