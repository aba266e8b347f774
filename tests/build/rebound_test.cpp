// Hierarchies bound by other volumes: what lies below a node lies in its volume, on the whole path from the root.

#include "grove/build/passes/rebound.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/task_arena.h>

#include <cmath>
#include <cstring>

#include "grove/base/random.h"
#include "grove/build/spatial_splits.h"
#include "grove/build/top_down.h"
#include "grove/geometry/user_geometry.h"

namespace grove {
namespace {

Vec3 random_point(Random& random) {
  return {random.next_float(), random.next_float(), random.next_float()};
}

TriangleMesh random_triangles(std::size_t count, float size, float scale, const Vec3& offset) {
  Random random(7);
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3 corner = random_point(random);
    for (int v = 0; v < 3; ++v) vertices.push_back(scale * (corner + size * random_point(random)) + offset);
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return {std::move(vertices), std::move(triangles)};
}

SphereSet random_spheres(std::size_t count) {
  Random random(8);
  std::vector<SphereSet::Sphere> spheres;
  for (std::size_t i = 0; i < count; ++i) spheres.push_back({random_point(random), random.next_float(0.001F, 0.1F)});
  return SphereSet(std::move(spheres));
}

// Boxes of a program's own, which no ray hits.
class Boxes final : public UserGeometry {
 public:
  [[nodiscard]] std::size_t size() const override { return 300; }
  [[nodiscard]] Box bounds(std::size_t i) const override {
    Random random(i);
    const Vec3 corner = random_point(random);
    return {corner, corner + 0.1F * random_point(random)};
  }
  [[nodiscard]] bool intersect_primitive(std::size_t /*i*/, const Ray& /*ray*/, Hit& /*hit*/) const override { return false; }
};

template <BoundingVolume V, EnclosableGeometry G>
VolumeBvh<V> build(const G& geometry, const CollapseSettings& settings) {
  const Bvh2 bvh = build_top_down(list_references(geometry), {.leaf_size = 1});
  return rebound<V>(bvh, list_hulls(geometry, bvh.references), settings);
}

// Calls check(volume, reference) for each reference and each volume on its path.
template <BoundingVolume V, typename Check>
void check_paths(const VolumeBvh<V>& bvh, std::uint32_t number, std::vector<V>& path, const Check& check) {
  const VolumeNode<V>& node = bvh.nodes[number];
  path.push_back(node.volume);
  for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
    if (node.is_leaf == 0) {
      check_paths(bvh, i, path, check);
      continue;
    }
    for (const V& volume : path) check(volume, bvh.references[i]);
  }
  path.pop_back();
}

template <BoundingVolume V, EnclosableGeometry G>
void expect_enclosed(const VolumeBvh<V>& bvh, const G& geometry) {
  ASSERT_EQ(bvh.validate(geometry.size()), "");
  std::size_t outside = 0;
  std::vector<V> path;
  check_paths(bvh, 0, path, [&](const V& volume, std::uint32_t reference) {
    const auto hull = enclosing_hull(geometry, reference);
    for (const Vec3& point : hull.points) {
      const glm::dvec3 centre = bvh.space.to_unit(point);
      for (int end = 0; end < (hull.radius > 0.0F ? 6 : 1); ++end) {
        glm::dvec3 p = centre;
        // A little inside the surface: the sum is rounded.
        p[end / 2] += (end % 2 == 0 ? 1.0 : -1.0) * (hull.radius * bvh.space.scale) * (1.0 - 1e-9);
        outside += volume.contains(p) ? 0 : 1;
      }
    }
  });
  EXPECT_EQ(outside, 0U);
}

template <typename V>
class Rebound : public testing::Test {};
using Volumes = testing::Types<OrientedBox, BoundingSphere>;
TYPED_TEST_SUITE(Rebound, Volumes, );

TYPED_TEST(Rebound, EnclosesWhatLiesBelow) {
  for (const int arity : {2, 4, 8}) {
    for (const Widening widening : {Widening::optimal, Widening::greedy}) {
      CollapseSettings settings;
      settings.arity = arity;
      settings.widening = widening;
      const TriangleMesh mesh = random_triangles(2000, 0.1F, 1.0F, Vec3(0.0F));
      expect_enclosed(build<TypeParam>(mesh, settings), mesh);
      const SphereSet spheres = random_spheres(1000);
      expect_enclosed(build<TypeParam>(spheres, settings), spheres);
      const Boxes boxes;
      expect_enclosed(build<TypeParam>(static_cast<const UserGeometry&>(boxes), settings), static_cast<const UserGeometry&>(boxes));
    }
  }
}

TYPED_TEST(Rebound, EnclosesScenesOfAnySizeAndPlace) {
  for (const float scale : {1e-40F, 1e-20F, 1e18F, 3e37F}) {
    const TriangleMesh mesh = random_triangles(500, 0.2F, scale, Vec3(0.0F));
    expect_enclosed(build<TypeParam>(mesh, {}), mesh);
  }
  const TriangleMesh far = random_triangles(500, 0.2F, 1.0F, Vec3(1e6F, -1e6F, 1e6F));
  expect_enclosed(build<TypeParam>(far, {}), far);
}

TYPED_TEST(Rebound, TakesDegenerateSets) {
  const Vec3 a(0.1F, 0.2F, 0.3F);
  const Vec3 b(0.9F, 0.3F, 0.4F);
  const Vec3 c(0.4F, 0.8F, 0.6F);
  for (const std::vector<Vec3>& corners :
       {std::vector<Vec3>{a, a, a}, std::vector<Vec3>{a, b, b}, std::vector<Vec3>{a, 0.5F * (a + b), b}, std::vector<Vec3>{a, b, c}}) {
    for (const std::size_t count : {1U, 2U, 100U}) {
      const TriangleMesh mesh(corners, std::vector<Triangle>(count, Triangle(0, 1, 2)));
      const auto bvh = build<TypeParam>(mesh, {});
      expect_enclosed(bvh, mesh);
      EXPECT_EQ(bvh.references.size(), count);
    }
  }
  const TriangleMesh none;
  EXPECT_TRUE(build<TypeParam>(none, {}).nodes.empty());
}

TYPED_TEST(Rebound, IsTheSameForAnyNumberOfThreads) {
  const TriangleMesh mesh = random_triangles(100000, 0.01F, 1.0F, Vec3(0.0F));
  const Bvh2 bvh = build_top_down(list_references(mesh), {.leaf_size = 1});
  std::vector<VolumeBvh<TypeParam>> built;
  for (const int threads : {1, 2, 3, 8}) {
    oneapi::tbb::task_arena arena(threads);
    built.push_back(arena.execute([&] { return rebound<TypeParam>(bvh, list_hulls(mesh, bvh.references), {}); }));
    const std::size_t bytes = built.front().nodes.size() * sizeof(VolumeNode<TypeParam>);
    ASSERT_EQ(built.back().nodes.size(), built.front().nodes.size());
    EXPECT_EQ(std::memcmp(built.back().nodes.data(), built.front().nodes.data(), bytes), 0) << threads << " threads";
    EXPECT_EQ(built.back().references, built.front().references);
  }
}

// With spatial splits a volume encloses whole primitives or the box of the pieces, and the latter is mostly less.
TEST(ReboundOrientedBoxes, AreNeverWorseThanTheBoxesOfPieces) {
  const TriangleMesh mesh = random_triangles(500, 0.8F, 1.0F, Vec3(0.0F));
  const Bvh2 bvh = build_with_spatial_splits(mesh, {.leaf_size = 1});
  ASSERT_GT(bvh.references.size(), mesh.size());
  const auto rebuilt = rebound<OrientedBox>(bvh, list_hulls(mesh, bvh.references), {.leaf_size = 1});
  ASSERT_EQ(rebuilt.validate(mesh.size()), "");
  // One reference a leaf: the same nodes in the same order.
  std::vector<float> areas;
  bvh.visit([&](const Box& box, std::uint32_t, std::uint32_t, std::uint32_t) { areas.push_back(rebuilt.space.to_unit(box).half_area()); });
  std::size_t i = 0;
  rebuilt.visit_nodes([&](const VolumeNode<OrientedBox>& node, std::uint32_t) { EXPECT_LE(node.volume.half_area(), areas.at(i++)); });
  EXPECT_EQ(i, areas.size());
}

// A thin slab of triangles, turned so that its axis-aligned box is almost a cube.
TEST(ReboundOrientedBoxes, FitARotatedSlab) {
  Random random(9);
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  const Vec3 u = glm::normalize(Vec3(1, 2, 3));
  const Vec3 v = glm::normalize(glm::cross(u, Vec3(0, 0, 1)));
  const Vec3 w = glm::cross(u, v);
  for (std::uint32_t i = 0; i < 900; ++i) {
    vertices.push_back(u * random.next_float() + v * random.next_float() + w * (0.01F * random.next_float()));
    if (i % 3 == 0) triangles.push_back({i, i + 1, i + 2});
  }
  const TriangleMesh mesh(vertices, triangles);
  const auto bvh = build<OrientedBox>(mesh, {});
  expect_enclosed(bvh, mesh);
  const Box unit = bvh.space.to_unit(bvh.bounds);
  EXPECT_LT(bvh.nodes[0].volume.half_area(), 0.5F * unit.half_area());
}

TEST(ReboundOrientedBoxes, HaveNoMoreAreaThanAlignedOnes) {
  const TriangleMesh mesh = random_triangles(3000, 0.3F, 1.0F, Vec3(0.0F));
  const auto bvh = build<OrientedBox>(mesh, {.leaf_size = 1});
  // Upwards from the leaves: the box around all references of a node.
  std::vector<Box> boxes(bvh.nodes.size());
  for (std::size_t i = bvh.nodes.size(); i-- > 0;) {
    const VolumeNode<OrientedBox>& node = bvh.nodes[i];
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k)
      boxes[i].grow(node.is_leaf != 0 ? mesh.bounds(bvh.references[k]) : boxes[k]);
    EXPECT_LE(node.volume.half_area(), bvh.space.to_unit(boxes[i]).half_area() * 1.000001F);
  }
}

}  // namespace
}  // namespace grove
