// No ray escapes from a closed mesh, and distances agree with exact arithmetic.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numeric>

#include "grove/base/parallel.h"
#include "grove/base/random.h"
#include "registry/matrix_geometry.h"

namespace grove::test {
namespace {

class Watertight : public testing::TestWithParam<std::string_view> {};

// From inside a closed mesh, at its vertices, at points of its edges, and anywhere. `offset` and `scale` place the mesh.
void expect_no_escape(std::string_view spec, const Vec3& offset, float scale, std::size_t ray_count) {
  const TriangleMesh unit = closed_mesh(spec == "brute" ? 2 : 5, 0.05F, 91);
  std::vector<Vec3> vertices(unit.vertices().begin(), unit.vertices().end());
  for (Vec3& v : vertices) v = v * scale + offset;
  const std::vector<Triangle> triangles(unit.triangles().begin(), unit.triangles().end());
  const auto structure = build(TriangleMesh(vertices, triangles), spec);
  std::vector<std::size_t> escaped(64, 0);
  parallel_chunks(ray_count, ray_count / escaped.size() + 1, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    Random random(1000 + chunk);
    for (std::size_t i = first; i < last; ++i) {
      const Vec3 inside(random.next_float(-0.5F, 0.5F), random.next_float(-0.5F, 0.5F), random.next_float(-0.5F, 0.5F));
      const Vec3 origin = inside * scale + offset;
      const Triangle& triangle = triangles[random.next_u32(static_cast<std::uint32_t>(triangles.size()))];
      const Vec3 a = vertices[triangle.x];
      const Vec3 b = vertices[triangle.y];
      const Vec3 targets[] = {a, a + 0.5F * (b - a), a + random.next_float() * (b - a)};
      const Vec3 direction = targets[i % 3] - origin;
      const Ray ray{origin, 0.0F, direction};
      if (!structure->intersect(ray)) ++escaped[chunk];
      if (!structure->occluded(ray)) ++escaped[chunk];
    }
  });
  std::size_t sum = 0;
  for (const std::size_t count : escaped) sum += count;
  EXPECT_EQ(sum, 0U) << "of " << ray_count;
}

TEST_P(Watertight, NoRayEscapesFromAClosedMesh) {
  const std::size_t rays = GetParam() == "brute" ? 20000 : 600000;
  expect_no_escape(GetParam(), Vec3(0.0F), 1.0F, rays);
}

TEST_P(Watertight, NoRayEscapesFarFromTheOriginOrAtExtremeScales) {
  const std::size_t rays = GetParam() == "brute" ? 5000 : 100000;
  expect_no_escape(GetParam(), Vec3(1000.0F, -3000.0F, 500.0F), 1.0F, rays);
  expect_no_escape(GetParam(), Vec3(0.0F), 1e-20F, rays);
  expect_no_escape(GetParam(), Vec3(0.0F), 1e18F, rays);
}

INSTANTIATE_TEST_SUITE_P(All, Watertight, testing::ValuesIn(representative_specs().begin(), representative_specs().end()),
                         [](const auto& test) {
                           std::string name(test.param);
                           for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
                           return name;
                         });
INSTANTIATE_TEST_SUITE_P(CompressedNodes, Watertight, testing::Values("fast:nodes=compressed"),
                         [](const auto& /*test*/) { return std::string("fast"); });

// In batches, at a mesh of two million triangles; a million rays, or as many as GROVE_WATERTIGHT_RAYS says.
class WatertightInBatches : public testing::TestWithParam<std::string_view> {};

TEST_P(WatertightInBatches, NoRayEscapesFromALargeClosedMesh) {
  constexpr std::size_t kBatch = 100000;
  const char* const asked = std::getenv("GROVE_WATERTIGHT_RAYS");  // NOLINT(concurrency-mt-unsafe)
  const std::size_t batches = (asked != nullptr ? std::stoull(asked) : 1000000) / kBatch;
  ASSERT_GT(batches, 0U);
  const auto mesh = std::make_shared<const TriangleMesh>(closed_mesh(9, 0.05F, 92));
  ASSERT_GT(mesh->size(), 1000000U);
  const auto structure = build(GeometryPointer(mesh), GetParam());
  std::vector<std::size_t> escaped(batches, 0);
  parallel_chunks(batches, 1, [&](std::size_t batch, std::size_t /*first*/, std::size_t /*last*/) {
    Random random(7000 + batch);
    std::vector<Ray> rays(kBatch);
    for (Ray& ray : rays) {
      ray.origin = Vec3(random.next_float(-0.5F, 0.5F), random.next_float(-0.5F, 0.5F), random.next_float(-0.5F, 0.5F));
      const Triangle& triangle = mesh->triangles()[random.next_u32(static_cast<std::uint32_t>(mesh->size()))];
      const Vec3 a = mesh->vertices()[triangle.x];
      const Vec3 b = mesh->vertices()[triangle.y];
      const Vec3 targets[] = {a, a + 0.5F * (b - a), a + random.next_float() * (b - a)};
      ray.direction = targets[random.next_u32(3)] - ray.origin;
    }
    std::vector<Hit> hits(kBatch);
    structure->intersect(rays, hits, {});
    for (const Hit& hit : hits) escaped[batch] += hit ? 0 : 1;
  });
  EXPECT_EQ(std::accumulate(escaped.begin(), escaped.end(), std::size_t{0}), 0U);
}

INSTANTIATE_TEST_SUITE_P(All, WatertightInBatches, testing::Values("fast", "fast:nodes=compressed"),
                         [](const auto& test) { return std::string(test.param.size() > 4 ? "compressed" : "full"); });

// t against the same intersection in long double, for triangles from slivers to walls and rays from all around.
TEST(TriangleDistance, IsRightToTheLastDigits) {
  Random random(7);
  std::size_t hits = 0;
  for (int i = 0; i < 200000; ++i) {
    const float size = std::pow(10.0F, random.next_float(-3.0F, 3.0F));
    Vec3 corners[3];
    for (Vec3& c : corners) c = size * Vec3(random.next_float(-1.0F, 1.0F), random.next_float(-1.0F, 1.0F), random.next_float(-1.0F, 1.0F));
    const Vec3 weights(random.next_float(0.05F, 1.0F), random.next_float(0.05F, 1.0F), random.next_float(0.05F, 1.0F));
    const Vec3 aim = (weights.x * corners[0] + weights.y * corners[1] + weights.z * corners[2]) / (weights.x + weights.y + weights.z);
    const Vec3 origin = 10.0F * Vec3(random.next_float(-1.0F, 1.0F), random.next_float(-1.0F, 1.0F), random.next_float(-1.0F, 1.0F));
    const Ray ray{origin, 0.0F, aim - origin};
    Hit hit;
    const std::uint32_t id = 3;
    if (!intersect_watertight(WatertightRay(ray), SingleTriangle(corners[0], corners[1], corners[2]).corners, &id, hit)) continue;
    ++hits;
    using Exact = glm::tvec3<long double>;
    const Exact e1 = Exact(corners[1]) - Exact(corners[0]);
    const Exact e2 = Exact(corners[2]) - Exact(corners[0]);
    const Exact n = glm::cross(e1, e2);
    const long double facing = glm::dot(n, Exact(ray.direction));
    // Edge-on, the distance is not a matter of precision.
    if (std::fabs(facing) < 0.01L * glm::length(n) * glm::length(Exact(ray.direction))) continue;
    const long double t = glm::dot(n, Exact(corners[0]) - Exact(origin)) / facing;
    EXPECT_NEAR(hit.t, static_cast<double>(t), 1e-7 * static_cast<double>(t)) << "triangle " << i;
    EXPECT_EQ(hit.primitive, 3U);
    const Vec3 point = (1.0F - hit.u - hit.v) * corners[0] + hit.u * corners[1] + hit.v * corners[2];
    EXPECT_NEAR(glm::length(point - ray.at(hit.t)), 0.0F, 1e-4F * (size + 10.0F));
  }
  EXPECT_GT(hits, 190000U);
}

TEST(TriangleTest, TakesBothSidesAndClosedLimits) {
  const SingleTriangle triangle(Vec3(0.0F), Vec3(1.0F, 0.0F, 0.0F), Vec3(0.0F, 1.0F, 0.0F));
  const std::uint32_t id = 0;
  for (const float side : {1.0F, -1.0F}) {
    Ray ray{{0.25F, 0.5F, side}, 0.0F, {0.0F, 0.0F, -side}};
    Hit hit;
    ASSERT_TRUE(intersect_watertight(WatertightRay(ray), triangle.corners, &id, hit));
    EXPECT_EQ(hit.t, 1.0F);
    EXPECT_EQ(hit.u, 0.25F);
    EXPECT_EQ(hit.v, 0.5F);
    ray.t_min = ray.t_max = 1.0F;
    EXPECT_TRUE(occluded_watertight(WatertightRay(ray), triangle.corners));
    ray.t_min = 0.0F;
    ray.t_max = std::nextafter(1.0F, 0.0F);
    EXPECT_FALSE(occluded_watertight(WatertightRay(ray), triangle.corners));
    ray.t_max = 2.0F;
    ray.t_min = std::nextafter(1.0F, 2.0F);
    EXPECT_FALSE(occluded_watertight(WatertightRay(ray), triangle.corners));
  }
}

}  // namespace
}  // namespace grove::test
