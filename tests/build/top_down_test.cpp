#include "grove/build/top_down.h"

#include <gtest/gtest.h>

#include <cmath>

#include "grove/base/random.h"
#include "grove/geometry/triangle_mesh.h"

namespace grove {
namespace {

TriangleMesh cloud(std::size_t count, float size, float spread) {
  Random random(5);
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3 corner = spread * Vec3(random.next_float(), random.next_float(), random.next_float());
    vertices.insert(vertices.end(), {corner, corner + Vec3(size, 0, 0), corner + Vec3(0, size, size)});
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return {std::move(vertices), std::move(triangles)};
}

TEST(BuildBinned, KeepsEveryInvariant) {
  for (const std::size_t count : {1U, 2U, 3U, 17U, 1000U, 9000U, 200000U}) {
    for (const std::uint32_t leaf_size : {1U, 4U, 64U}) {
      const TriangleMesh mesh = cloud(count, 0.05F, 1.0F);
      const Bvh2 bvh = build_top_down(list_references(mesh), {.leaf_size = leaf_size, .cost = {}});
      EXPECT_EQ(bvh.validate(count), "") << count << " triangles, leaf size " << leaf_size;
      bvh.visit([&](const Box&, std::uint32_t, std::uint32_t, std::uint32_t references) { EXPECT_LE(references, leaf_size); });
    }
  }
}

TEST(BuildBinned, LeavesOutWhatCannotBeHit) {
  std::vector<Vec3> vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {NAN, 0, 0}};
  std::vector<Triangle> triangles;
  for (int i = 0; i < 40000; ++i) triangles.push_back(i % 3 == 0 ? Triangle(0, 1, 3) : Triangle(0, 1, 2));
  const Bvh2 bvh = build_top_down(list_references(TriangleMesh(vertices, triangles)), {});
  EXPECT_EQ(bvh.references.size(), 26666U);
  EXPECT_EQ(bvh.validate(triangles.size()), "");
  for (const std::uint32_t id : bvh.references) EXPECT_NE(id % 3, 0U);
}

TEST(BuildBinned, BeatsAMedianSplitByCost) {
  // Two dense clusters and little between: a surface-area split must find the gap.
  const TriangleMesh left = cloud(500, 0.01F, 0.1F);
  std::vector<Vec3> vertices(left.vertices().begin(), left.vertices().end());
  std::vector<Triangle> triangles(left.triangles().begin(), left.triangles().end());
  const auto first = static_cast<std::uint32_t>(vertices.size());
  for (std::size_t i = 0; i < 300; ++i) vertices.push_back(vertices[i] + Vec3(10.0F, 0.0F, 0.0F));
  for (std::uint32_t i = 0; i < 100; ++i) triangles.push_back(Triangle(3 * i, 3 * i + 1, 3 * i + 2) + first);
  const Bvh2 bvh = build_top_down(list_references(TriangleMesh(vertices, triangles)), {});
  ASSERT_FALSE(bvh.nodes.empty());
  EXPECT_LT(bvh.nodes[0].child_box(0).upper.x, 1.0F);
  EXPECT_GT(bvh.nodes[0].child_box(1).lower.x, 9.0F);
}

// Sizes that grow by a factor at each step lure the heuristic into peeling off one primitive at a time.
TEST(BuildBinned, DepthStaysBoundedForExponentialSizes) {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  float x = 1e-35F;
  for (std::uint32_t i = 0; i < 240; ++i, x *= 2.0F) {
    vertices.insert(vertices.end(), {Vec3(x, 0, 0), Vec3(x, x, 0), Vec3(x, 0, x)});
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const Bvh2 bvh = build_top_down(list_references(TriangleMesh(vertices, triangles)), {.leaf_size = 1, .cost = {}});
  EXPECT_EQ(bvh.validate(triangles.size()), "");
  EXPECT_LE(bvh.depth, Bvh2::kMaxDepth);
}

}  // namespace
}  // namespace grove
