// The batch kernels of the fast path on every instruction set that the machine has: hits of any batch are those of brute force, bit for bit.

#include "grove/traverse/simd/fast_batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>

#include "grove/base/error.h"
#include "grove/base/random.h"
#include "registry/matrix_geometry.h"
#include "registry/matrix_rays.h"
#include "registry/matrix_specs.h"

namespace grove::test {
namespace {

// By instruction set and the rest of the spec.
class FastBatch : public testing::TestWithParam<std::tuple<std::string, std::string>> {
 protected:
  void SetUp() override { force_batch_target(std::get<0>(GetParam())); }
  void TearDown() override { force_batch_target(""); }

  // `triangles` is a value of that key.
  [[nodiscard]] static std::string spec(const std::string& triangles = "watertight") {
    return "fast:nodes=" + std::get<1>(GetParam()) + ",triangles=" + triangles;
  }
};

// What is scaled up or down has the same hits at other distances, and does not go through the kernel.
std::vector<Ray> with_long_and_short_directions(std::vector<Ray> rays) {
  const std::size_t count = rays.size();
  for (std::size_t i = 0; i < count; i += 3) {
    Ray scaled = rays[i];
    scaled.direction *= i % 2 == 0 ? 1e-12F : 1e12F;
    scaled.t_max = std::numeric_limits<float>::infinity();
    scaled.t_min = 0.0F;
    rays.push_back(scaled);
  }
  // Neighbours in a batch are of different kinds.
  Random random(3);
  for (std::size_t i = rays.size(); i > 1; --i) std::swap(rays[i - 1], rays[random.next_u32(static_cast<std::uint32_t>(i))]);
  return rays;
}

// Each ray with neighbours that go nearly its way, so that kernels may take them side by side; some end early.
std::vector<Ray> with_neighbours(std::span<const Ray> rays, std::size_t neighbours) {
  std::vector<Ray> all;
  all.reserve(rays.size() * (1 + neighbours));
  Random random(4);
  for (const Ray& ray : rays) {
    all.push_back(ray);
    const bool is_fan = random.next_u32(2) == 0;
    for (std::size_t i = 0; i < neighbours; ++i) {
      Ray near = ray;
      for (int axis = 0; axis < 3; ++axis) {
        near.direction[axis] *= random.next_float(0.99F, 1.01F);
        if (!is_fan) near.origin[axis] += random.next_float(-0.005F, 0.005F);
      }
      if (random.next_u32(8) == 0) near.t_max = random.next_float();
      all.push_back(near);
    }
  }
  return all;
}

void expect_hits_of_brute_force(const NamedGeometry& named, const Accelerator& structure, std::span<const Ray> rays,
                                std::span<const std::size_t> batches) {
  std::vector<Hit> expected(rays.size());
  build(named.geometry, "brute")->intersect(rays, expected, {});
  for (const std::size_t batch : batches) {
    std::vector<Hit> hits(rays.size());
    std::vector<std::uint8_t> results(rays.size(), 7);
    for (std::size_t first = 0; first < rays.size(); first += batch) {
      const std::size_t count = std::min(batch, rays.size() - first);
      structure.intersect({rays.data() + first, count}, {hits.data() + first, count}, {});
      structure.occluded({rays.data() + first, count}, {results.data() + first, count}, {});
    }
    for (std::size_t i = 0; i < rays.size(); ++i) {
      ASSERT_TRUE(same_bits(hits[i], expected[i]))
          << named.name << ", batches of " << batch << ", ray " << i << ": t " << hits[i].t << " and " << expected[i].t << ", primitives "
          << hits[i].primitive << " and " << expected[i].primitive;
      ASSERT_EQ(results[i], expected[i] ? 1 : 0) << named.name << ", batches of " << batch << ", ray " << i;
    }
  }
}

TEST_P(FastBatch, FindsWhatBruteForceFinds) {
  for (const NamedGeometry& named : matrix_geometries()) {
    if (!std::holds_alternative<std::shared_ptr<const TriangleMesh>>(named.geometry)) continue;
    const std::vector<Ray> rays = with_long_and_short_directions(matrix_rays(named.geometry, 40, 9));
    const std::size_t batches[] = {1, 5, 49, rays.size()};
    expect_hits_of_brute_force(named, *build(named.geometry, spec()), rays, batches);
  }
}

TEST_P(FastBatch, FindsWhatBruteForceFindsForRaysSideBySide) {
  for (const NamedGeometry& named : matrix_geometries()) {
    if (!std::holds_alternative<std::shared_ptr<const TriangleMesh>>(named.geometry)) continue;
    const std::vector<Ray> rays = with_neighbours(matrix_rays(named.geometry, 2, 13), 31);
    const std::size_t batches[] = {32, 100, rays.size()};
    expect_hits_of_brute_force(named, *build(named.geometry, spec()), rays, batches);
  }
}

TEST_P(FastBatch, SingleRaysFindTheSame) {
  for (const NamedGeometry& named : matrix_geometries()) {
    if (!std::holds_alternative<std::shared_ptr<const TriangleMesh>>(named.geometry)) continue;
    const auto oracle = build(named.geometry, "brute");
    const auto structure = build(named.geometry, spec());
    TraversalCounts counts;
    for (const Ray& ray : with_long_and_short_directions(matrix_rays(named.geometry, 40, 11))) {
      const Hit expected = oracle->closest_hit(ray, nullptr);
      ASSERT_TRUE(same_bits(structure->closest_hit(ray, nullptr), expected)) << named.name;
      ASSERT_TRUE(same_bits(structure->closest_hit(ray, &counts), expected)) << named.name << ", with counters";
      ASSERT_EQ(structure->any_hit(ray, nullptr), static_cast<bool>(expected)) << named.name;
      ASSERT_EQ(structure->any_hit(ray, &counts), static_cast<bool>(expected)) << named.name << ", with counters";
    }
    if (std::visit([](const auto& set) { return set->size(); }, named.geometry) < 5) continue;
    EXPECT_GT(counts.nodes_visited, 0U) << named.name;
    EXPECT_GE(counts.primitives_tested, counts.leaves_entered) << named.name;
  }
}

TEST_P(FastBatch, CountsTheSameInAnyBatch) {
  const GeometryPointer geometry = std::make_shared<const TriangleMesh>(random_triangles(1500, 0.2F, 3));
  const auto structure = build(geometry, spec());
  const std::vector<Ray> rays = with_long_and_short_directions(matrix_rays(geometry, 40, 10));
  std::vector<Hit> hits(rays.size());
  std::vector<TraversalCounts> together(rays.size(), TraversalCounts{1, 1, 1, 1});
  structure->intersect(rays, hits, together);
  std::uint64_t nodes = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    TraversalCounts alone;
    structure->intersect({&rays[i], 1}, {&hits[i], 1}, {&alone, 1});
    EXPECT_EQ(alone, together[i]);
    nodes += alone.nodes_visited;
  }
  EXPECT_GT(nodes, rays.size() / 4);
}

// The test that rounds: what is found is the same one by one as in batches, for rays that aim at trouble too.
TEST_P(FastBatch, TrianglesInFloatsAreHitTheSameInAnyBatch) {
  const GeometryPointer geometry = std::make_shared<const TriangleMesh>(random_triangles(1500, 0.2F, 4));
  const auto structure = build(geometry, spec("fast"));
  const std::vector<Ray> rays = matrix_rays(geometry, 40, 12);
  std::vector<Hit> hits(rays.size());
  std::vector<std::uint8_t> results(rays.size());
  structure->intersect(rays, hits, {});
  structure->occluded(rays, results, {});
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_TRUE(same_bits(hits[i], structure->intersect(rays[i]))) << "ray " << i;
    EXPECT_EQ(results[i], hits[i] ? 1 : 0) << "ray " << i;
    EXPECT_EQ(structure->occluded(rays[i]), static_cast<bool>(hits[i])) << "ray " << i;
  }
}

// And hits are where brute force has them, but for a few at edges.
TEST_P(FastBatch, TrianglesInFloatsAreHitWhereBruteForceHitsThem) {
  const GeometryPointer geometry = std::make_shared<const TriangleMesh>(random_triangles(1500, 0.2F, 4));
  const auto oracle = build(geometry, "brute");
  const auto structure = build(geometry, spec("fast"));
  Random random(8);
  const auto point = [&] { return Vec3(random.next_float(-1.0F, 2.0F), random.next_float(-1.0F, 2.0F), random.next_float(-1.0F, 2.0F)); };
  std::vector<Ray> rays(5000);
  for (Ray& ray : rays) {
    ray.origin = point();
    ray.direction = point() - ray.origin;
  }
  std::vector<Hit> expected(rays.size());
  std::vector<Hit> hits(rays.size());
  oracle->intersect(rays, expected, {});
  structure->intersect(rays, hits, {});
  std::size_t far_off = 0;
  std::size_t found = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const bool agree = expected[i] ? hits[i] && std::abs(hits[i].t - expected[i].t) <= 1e-3F * expected[i].t : !hits[i];
    far_off += agree ? 0 : 1;
    found += expected[i] ? 1 : 0;
  }
  EXPECT_GT(found, rays.size() / 10);
  EXPECT_LE(far_off, rays.size() / 1000);
}

INSTANTIATE_TEST_SUITE_P(Targets, FastBatch, testing::Combine(testing::ValuesIn(batch_targets()), testing::Values("full", "compressed")),
                         [](const auto& test) { return std::get<0>(test.param) + "_" + std::get<1>(test.param); });

TEST(FastBatchTargets, UnknownOnesAreRefusedWithAList) {
  try {
    force_batch_target("AVX4711");
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find(batch_targets().front()), std::string::npos);
  }
}

}  // namespace
}  // namespace grove::test
