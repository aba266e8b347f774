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
#include "registry/refusals.h"

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
    const std::vector<Ray> rays = with_neighbours(matrix_rays(named.geometry, 2, 13), 63);
    const std::size_t batches[] = {32, 64, 300, rays.size()};
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

bool refuse_half_of_ray(void* /*context*/, std::size_t ray, const Hit& hit) {
  return is_in_half(hit, static_cast<std::uint32_t>(ray));
}

// Twelve of the meshes in `geometries`, each built by `spec`, under different transforms that let them overlap.
GeometryPointer instances_of(const std::vector<GeometryPointer>& geometries, const std::string& spec) {
  std::vector<std::shared_ptr<const Accelerator>> objects;
  objects.reserve(geometries.size());
  for (const GeometryPointer& geometry : geometries) objects.emplace_back(build(geometry, spec));
  std::vector<InstanceSet::Instance> instances;
  for (std::size_t i = 0; i < 12; ++i) {
    Mat4 matrix(1.0F);
    const float step = 0.15F * static_cast<float>(i);
    matrix[0] = Vec4(std::cos(step), std::sin(step), 0, 0);
    matrix[1] = Vec4(-std::sin(step), std::cos(step), 0, 0);
    matrix[3] = Vec4(step, 0.5F * step, 0, 1);
    instances.push_back({objects[i % objects.size()], Transform(matrix)});
  }
  return std::make_shared<const InstanceSet>(std::move(instances));
}

// Structures over the same, the first by brute force.
struct Filtered {
  std::string name;
  std::unique_ptr<Accelerator> oracle;
  std::unique_ptr<Accelerator> structure;
  GeometryPointer geometry;
};

std::vector<Filtered> filtered(const std::string& spec) {
  std::vector<Filtered> all;
  std::vector<GeometryPointer> meshes;
  for (const NamedGeometry& named : matrix_geometries()) {
    if (!std::holds_alternative<std::shared_ptr<const TriangleMesh>>(named.geometry)) continue;
    all.push_back({named.name, build(named.geometry, "brute"), build(named.geometry, spec), named.geometry});
    if (size_of(named.geometry) > 100) meshes.push_back(named.geometry);
  }
  const GeometryPointer top = instances_of(meshes, spec);
  all.push_back({"instances", build(instances_of(meshes, "brute"), "brute"), build(top, spec), top});
  return all;
}

TEST_P(FastBatch, FindsWhatAFilterLeaves) {
  const BatchHitFilter filter(refuse_half_of_ray, nullptr);
  std::size_t hit_count = 0;
  for (const Filtered& of : filtered(spec())) {
    std::vector<Ray> rays = with_long_and_short_directions(matrix_rays(of.geometry, 8, 13));
    const std::vector<Ray> side_by_side = with_neighbours(matrix_rays(of.geometry, 1, 15), 63);
    rays.resize(rays.size() / 32 * 32);  // neighbours fall into one group of the kernel
    rays.insert(rays.end(), side_by_side.begin(), side_by_side.end());
    std::vector<Hit> hits(rays.size());
    std::vector<std::uint8_t> results(rays.size(), 7);
    of.structure->intersect(rays, hits, filter);
    of.structure->occluded(rays, results, filter);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      FilterOfOneRay of_one(filter, i);
      const Hit expected = of.oracle->closest_hit(rays[i], of_one.filter());
      hit_count += expected ? 1 : 0;
      ASSERT_TRUE(same_bits(hits[i], expected)) << of.name << ", ray " << i << ": t " << hits[i].t << " and " << expected.t;
      ASSERT_TRUE(same_bits(of.structure->closest_hit(rays[i], of_one.filter()), expected)) << of.name << ", single ray " << i;
      ASSERT_EQ(results[i], expected ? 1 : 0) << of.name << ", any hit of ray " << i;
      ASSERT_EQ(of.structure->any_hit(rays[i], of_one.filter()), static_cast<bool>(expected)) << of.name << ", any hit of single ray " << i;
    }
  }
  EXPECT_GT(hit_count, 1000U);
}

// Light that passes many surfaces is weakened by each: any hit must ask about all that lie on the ray.
TEST_P(FastBatch, AsksAboutAllThatIsRefused) {
  std::size_t most = 0;
  for (const Filtered& of : filtered(spec())) {
    std::vector<Ray> rays = with_neighbours(matrix_rays(of.geometry, 1, 16), 63);
    const std::vector<Ray> others = with_long_and_short_directions(matrix_rays(of.geometry, 3, 14));
    rays.insert(rays.end(), others.begin(), others.end());
    RefuseAll on_the_rays;
    RefuseAll asked;
    RefuseAll asked_in_batch;
    std::vector<std::uint8_t> results(rays.size(), 7);
    of.structure->occluded(rays, results, asked_in_batch.batch_filter());
    for (std::size_t i = 0; i < rays.size(); ++i) {
      EXPECT_EQ(results[i], 0) << of.name << ", ray " << i;
      FilterOfOneRay all(on_the_rays.batch_filter(), i);
      EXPECT_FALSE(of.oracle->any_hit(rays[i], all.filter()));
      FilterOfOneRay some(asked.batch_filter(), i);
      EXPECT_FALSE(of.structure->any_hit(rays[i], some.filter()));
    }
    most = std::max(most, on_the_rays.asked().size());
    EXPECT_TRUE(asked.asked() == on_the_rays.asked()) << of.name << ": " << asked.asked().size() << " of " << on_the_rays.asked().size();
    EXPECT_TRUE(asked_in_batch.asked() == on_the_rays.asked())
        << of.name << ", in batches: " << asked_in_batch.asked().size() << " of " << on_the_rays.asked().size();
  }
  EXPECT_GT(most, 1000U);
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
  const BatchHitFilter filter(refuse_half_of_ray, nullptr);
  structure->intersect(rays, hits, filter);
  structure->occluded(rays, results, filter);
  std::size_t hit_count = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    FilterOfOneRay of_one(filter, i);
    EXPECT_TRUE(same_bits(hits[i], structure->closest_hit(rays[i], of_one.filter()))) << "filtered ray " << i;
    EXPECT_TRUE(!hits[i] || of_one(hits[i])) << "filtered ray " << i;
    EXPECT_EQ(results[i], hits[i] ? 1 : 0) << "filtered ray " << i;
    EXPECT_EQ(structure->any_hit(rays[i], of_one.filter()), static_cast<bool>(hits[i])) << "filtered ray " << i;
    hit_count += hits[i] ? 1 : 0;
  }
  EXPECT_GT(hit_count, rays.size() / 10);
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
