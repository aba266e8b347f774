// Every registered structure against brute force, on every kind of geometry and on rays that aim at trouble: hits must be equal bit for bit.

#include <gtest/gtest.h>
#include <oneapi/tbb/task_arena.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <map>

#include "grove/base/random.h"
#include "registry/matrix_geometry.h"
#include "registry/matrix_rays.h"
#include "registry/matrix_specs.h"
#include "registry/refusals.h"

namespace grove::test {
namespace {

// Each value of each key of a family on its own.
std::vector<std::string> specs_of(const StructureFamily& family) {
  std::vector<std::string> specs;
  for (const SpecKey& key : family.keys) {
    std::vector<std::string> values(key.values.begin(), key.values.end());
    if (key.is_number()) values = {std::to_string(key.minimum), std::to_string(key.maximum)};
    for (const std::string& value : values) {
      const std::string spec = canonical_spec(std::string(family.name) + ":" + std::string(key.name) + "=" + value);
      // What rounds has tests of its own.
      if (!rounds_hits(spec)) specs.push_back(spec);
    }
  }
  return specs;
}

void add_new(std::vector<std::string>& specs, const std::vector<std::string>& others) {
  for (const std::string& spec : others)
    if (std::find(specs.begin(), specs.end(), spec) == specs.end()) specs.push_back(spec);
}

// The representative specs, and each value of each key on its own, of the families whose keys are not combined.
std::vector<std::string> listed_specs() {
  std::vector<std::string> specs = representatives();
  for (const StructureFamily& family : structure_families())
    if (combined_specs(family.name).empty() && !builds_others(family.name)) add_new(specs, specs_of(family));
  return specs;
}

// What the matrix leaves out of the families whose keys are combined or that build others: each value on its own, and the splits with some.
std::vector<std::string> left_out_specs() {
  std::vector<std::string> specs = listed_specs();
  const std::size_t listed = specs.size();
  for (const StructureFamily& family : structure_families())
    if (!combined_specs(family.name).empty() || builds_others(family.name)) add_new(specs, specs_of(family));
  for (const char* const split : {"sah", "binned", "object-median", "spatial-median"})
    for (const char* const rest :
         {"walk=ropes", "walk=ropes,clip=false", "mailbox=false,clip=false,empty-bonus=0", "walk=ropes,mailbox=false,max-depth=4"})
      add_new(specs, {canonical_spec(std::string("kdtree:split=") + split + "," + rest)});
  specs.erase(specs.begin(), specs.begin() + static_cast<std::ptrdiff_t>(listed));
  return specs;
}

// And keys that meet in one pass.
std::vector<std::string> matrix_specs() {
  std::vector<std::string> specs = listed_specs();
  for (const char* const spec : {"bvh:bounds=obb,arity=8", "bvh:split=spatial,bounds=obb,arity=4,widen=greedy",
                                 "bvh:split=ploc,bounds=sphere,arity=4", "bvh:split=spatial,bounds=sphere,arity=8,optimize=reinsertion"})
    specs.emplace_back(spec);
  return specs;
}

// Those that build something.
std::vector<std::string> built_specs() {
  std::vector<std::string> specs = listed_specs();
  std::erase(specs, "brute");
  return specs;
}

const std::vector<NamedGeometry>& geometries() {
  static const std::vector<NamedGeometry> all = matrix_geometries();
  return all;
}

std::string describe(const Ray& ray) {
  char line[256];
  std::snprintf(line, sizeof line, "origin (%a %a %a) direction (%a %a %a) t [%a, %a]", ray.origin.x, ray.origin.y, ray.origin.z,
                ray.direction.x, ray.direction.y, ray.direction.z, ray.t_min, ray.t_max);
  return line;
}

std::string describe(const Hit& hit) {
  char line[128];
  std::snprintf(line, sizeof line, "t %a u %a v %a primitive %u geometry %u instance %u", hit.t, hit.u, hit.v, hit.primitive, hit.geometry,
                hit.instance);
  return line;
}

void expect_equal_hits(const Accelerator& structure, const Accelerator& oracle, const std::vector<Ray>& rays) {
  std::size_t differences = 0;
  for (const Ray& ray : rays) {
    const Hit expected = oracle.intersect(ray);
    const Hit found = structure.intersect(ray);
    const bool any = structure.occluded(ray);
    if (same_bits(expected, found) && any == static_cast<bool>(expected)) continue;
    if (++differences <= 3)
      ADD_FAILURE() << describe(ray) << "\n  expected " << describe(expected) << "\n  found    " << describe(found) << "\n  any hit  "
                    << any;
  }
  EXPECT_EQ(differences, 0U) << "of " << rays.size() << " rays";
}

bool refuse_half(void* /*context*/, const Hit& hit) {
  return is_in_half(hit);
}

// Each ray of a batch has a filter of its own: the half that is refused differs.
bool refuse_half_of_ray(void* /*context*/, std::size_t ray, const Hit& hit) {
  return is_in_half(hit, static_cast<std::uint32_t>(ray));
}

void expect_equal_filtered_hits(const Accelerator& structure, const Accelerator& oracle, const std::vector<Ray>& rays) {
  const BatchHitFilter filter(refuse_half_of_ray, nullptr);
  std::vector<Hit> hits(rays.size());
  std::vector<std::uint8_t> occluded(rays.size(), 7);
  structure.intersect(rays, hits, filter);
  structure.occluded(rays, occluded, filter);
  std::size_t differences = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Ray& ray = rays[i];
    FilterOfOneRay of_one(filter, i);
    const Hit expected = oracle.closest_hit(ray, of_one.filter());
    const Hit found = structure.closest_hit(ray, of_one.filter());
    const bool any = structure.any_hit(ray, of_one.filter());
    RefuseAll on_the_ray;
    RefuseAll asked;
    // Brute force takes its time: some rays will do.
    const bool goes_on = i % 4 != 0 || (!oracle.any_hit(ray, on_the_ray.filter()) && !structure.any_hit(ray, asked.filter()));
    if (same_bits(expected, found) && same_bits(expected, hits[i]) && any == static_cast<bool>(expected) &&
        occluded[i] == (expected ? 1 : 0) && goes_on && on_the_ray.asked() == asked.asked())
      continue;
    if (++differences <= 3)
      ADD_FAILURE() << describe(ray) << "\n  expected " << describe(expected) << "\n  found    " << describe(found) << "\n  in batch "
                    << describe(hits[i]) << "\n  any hit  " << any << ", in batch " << int{occluded[i]} << "\n  asked    "
                    << asked.asked().size() << " of " << on_the_ray.asked().size();
  }
  EXPECT_EQ(differences, 0U) << "of " << rays.size() << " filtered rays";
}

// What brute force finds with a filter is what it finds without the refused triangles.
TEST(FilteredHits, AreThoseOfAMeshWithoutTheRefused) {
  const TriangleMesh whole = random_triangles(300, 0.3F, 5);
  TriangleMesh left = whole;
  for (std::uint32_t i = 0; i < left.size(); ++i)
    if (!refuse_half(nullptr, {.t = 1.0F, .primitive = i, .geometry = 0})) left.remove_triangle(i);
  const auto in_left_half = [](void* /*context*/, const Hit& hit) {
    return refuse_half(nullptr, {.primitive = hit.primitive, .geometry = 0});
  };
  const auto oracle = build(GeometryPointer(std::make_shared<const TriangleMesh>(left)), "brute");
  const auto filtered = build(GeometryPointer(std::make_shared<const TriangleMesh>(whole)), "brute");
  int hit_count = 0;
  for (const Ray& ray : matrix_rays(GeometryPointer(std::make_shared<const TriangleMesh>(whole)), 40, 46)) {
    const Hit expected = oracle->intersect(ray);
    EXPECT_TRUE(same_bits(expected, filtered->closest_hit(ray, HitFilter{in_left_half})));
    EXPECT_EQ(filtered->any_hit(ray, HitFilter{in_left_half}), static_cast<bool>(expected));
    hit_count += expected ? 1 : 0;
  }
  EXPECT_GT(hit_count, 100);
}

// A sphere is met twice; where the near side is refused the far one may count.
TEST(FilteredHits, FindTheFarSideOfASphere) {
  const auto spheres = std::make_shared<const SphereSet>(std::vector<SphereSet::Sphere>{{{0, 0, 0}, 1.0F}});
  const auto beyond_origin = [](void* /*context*/, const Hit& hit) { return hit.t > 3.0F; };
  for (const std::string& spec : representatives()) {
    const auto structure = build(GeometryPointer(spheres), spec);
    const Ray ray{.origin = {0, 0, 3}, .direction = {0, 0, -1}};
    EXPECT_EQ(structure->closest_hit(ray, HitFilter{beyond_origin}).t, 4.0F) << spec;
    EXPECT_TRUE(structure->any_hit(ray, HitFilter{beyond_origin})) << spec;
  }
}

class StructureMatrix : public testing::TestWithParam<std::tuple<std::string, std::size_t>> {
 protected:
  [[nodiscard]] static std::string spec() { return std::get<0>(GetParam()); }
  [[nodiscard]] static const NamedGeometry& geometry() { return geometries()[std::get<1>(GetParam())]; }
};

TEST_P(StructureMatrix, HitsEqualBruteForce) {
  const std::unique_ptr<Accelerator> oracle = build(geometry().geometry, "brute");
  const std::unique_ptr<Accelerator> structure = build(geometry().geometry, spec());
  expect_equal_hits(*structure, *oracle, matrix_rays(geometry().geometry, 150, 42));
  expect_equal_filtered_hits(*structure, *oracle, matrix_rays(geometry().geometry, 8, 47));
}

TEST_P(StructureMatrix, BatchesAndCountersChangeNothing) {
  const std::unique_ptr<Accelerator> structure = build(geometry().geometry, spec());
  const std::vector<Ray> rays = matrix_rays(geometry().geometry, 20, 43);
  std::vector<Hit> hits(rays.size());
  std::vector<Hit> counted_hits(rays.size());
  std::vector<std::uint8_t> occluded(rays.size());
  std::vector<std::uint8_t> counted_occluded(rays.size());
  std::vector<TraversalCounts> counts(rays.size());
  structure->intersect(rays, hits);
  structure->intersect(rays, counted_hits, counts);
  structure->occluded(rays, occluded);
  structure->occluded(rays, counted_occluded, counts);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_TRUE(same_bits(hits[i], structure->intersect(rays[i])));
    EXPECT_TRUE(same_bits(hits[i], counted_hits[i]));
    EXPECT_EQ(occluded[i] != 0, static_cast<bool>(hits[i]));
    EXPECT_EQ(occluded[i], counted_occluded[i]);
  }
}

TEST_P(StructureMatrix, StatisticsAddUp) {
  const std::unique_ptr<Accelerator> structure = build(geometry().geometry, spec());
  const StructureStatistics& statistics = structure->statistics();
  EXPECT_EQ(statistics.primitives, size_of(geometry().geometry));
  EXPECT_GE(statistics.expected_cost, 0.0);
  EXPECT_TRUE(std::isfinite(statistics.expected_cost));
  std::uint64_t nodes = 0;
  std::uint64_t leaves = 0;
  std::uint64_t references = 0;
  std::uint32_t depth = 0;
  structure->visit_nodes([&](const NodeView& node) {
    ++nodes;
    leaves += node.is_leaf ? 1 : 0;
    references += node.is_leaf ? node.reference_count : 0;
    depth = std::max(depth, node.depth);
    EXPECT_TRUE(structure->bounds().contains(node.box));
  });
  if (spec() == "brute") return;
  EXPECT_EQ(nodes, statistics.nodes);
  EXPECT_EQ(leaves, statistics.leaves);
  EXPECT_EQ(references, statistics.references);
  EXPECT_EQ(depth, statistics.depth);
}

INSTANTIATE_TEST_SUITE_P(All, StructureMatrix,
                         testing::Combine(testing::ValuesIn(matrix_specs()), testing::Range<std::size_t>(0, geometries().size())),
                         [](const auto& test) {
                           return as_test_name(std::get<0>(test.param) + "_" + geometries()[std::get<1>(test.param)].name);
                         });

class CombinedKeys : public testing::TestWithParam<std::string> {};

TEST_P(CombinedKeys, GiveHitsOfBruteForce) {
  for (const NamedGeometry& named : geometries()) {
    SCOPED_TRACE(named.name);
    const std::unique_ptr<Accelerator> oracle = build(named.geometry, "brute");
    const std::unique_ptr<Accelerator> structure = build(named.geometry, GetParam());
    expect_equal_hits(*structure, *oracle, matrix_rays(named.geometry, 40, 45));
    expect_equal_filtered_hits(*structure, *oracle, matrix_rays(named.geometry, 4, 48));
  }
}

INSTANTIATE_TEST_SUITE_P(All, CombinedKeys, testing::ValuesIn(left_out_specs()), [](const auto& test) { return as_test_name(test.param); });

class EachStructure : public testing::TestWithParam<std::string> {};

// Random triangles with corners on a lattice of eight steps a side, and rays between lattice points: ties, shared edges, rays in planes and
// through corners are the rule.
RC_GTEST_PROP(LatticeProperty, HitsEqualBruteForce, ()) {
  const auto corner = rc::gen::map(rc::gen::tuple(rc::gen::inRange(0, 9), rc::gen::inRange(0, 9), rc::gen::inRange(0, 9)),
                                   [](const std::tuple<int, int, int>& c) { return Vec3(std::get<0>(c), std::get<1>(c), std::get<2>(c)); });
  const auto corners = *rc::gen::container<std::vector<Vec3>>(corner);
  const auto ends = *rc::gen::container<std::vector<std::pair<Vec3, Vec3>>>(rc::gen::pair(corner, corner));
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i + 2 < corners.size(); ++i) triangles.push_back({i, i + 1, i + 2});
  const auto mesh = std::make_shared<const TriangleMesh>(corners, triangles);
  const auto oracle = build(GeometryPointer(mesh), "brute");
  for (const std::string& spec : matrix_specs()) {
    const auto structure = build(GeometryPointer(mesh), spec);
    for (const auto& [from, to] : ends) {
      const Ray ray{from, 0.0F, to - from, 2.0F};
      const Hit expected = oracle->intersect(ray);
      RC_ASSERT(same_bits(structure->intersect(ray), expected));
      RC_ASSERT(structure->occluded(ray) == static_cast<bool>(expected));
    }
  }
}

// The whole structure as one string of bytes that can be compared.
std::vector<std::uint64_t> fingerprint(const Accelerator& structure) {
  std::vector<std::uint64_t> words;
  structure.visit_nodes([&](const NodeView& node) {
    for (int axis = 0; axis < 3; ++axis) {
      words.push_back(std::bit_cast<std::uint32_t>(static_cast<float>(node.box.lower[axis])));
      words.push_back(std::bit_cast<std::uint32_t>(static_cast<float>(node.box.upper[axis])));
    }
    words.push_back(node.depth);
    words.push_back(node.is_leaf ? node.reference_count + 1ULL : 0ULL);
  });
  return words;
}

TEST_P(EachStructure, IsTheSameForAnyNumberOfThreads) {
  // Large enough for every stage of parallel building: 131,072 is the most that is split by one thread, so the first level, or with 300,000 two, are split by
  // all. Those that are optimised or search long have the same first levels as others.
  const std::string_view spec = GetParam();
  const bool is_slow = spec.find("reinsertion") != spec.npos || spec.find("high") != spec.npos || spec.find("joint") != spec.npos;
  const auto mesh = std::make_shared<const TriangleMesh>(random_triangles(is_slow ? 140000 : 300000, 0.02F, 77));
  const std::vector<Ray> rays = matrix_rays(GeometryPointer(mesh), 20, 44);
  std::vector<std::uint64_t> first_nodes;
  std::vector<Hit> first_hits(rays.size());
  std::vector<TraversalCounts> first_counts(rays.size());
  for (const int threads : {1, 3, 8}) {
    oneapi::tbb::task_arena arena(threads);
    const auto structure = arena.execute([&] { return build(GeometryPointer(mesh), GetParam()); });
    std::vector<Hit> hits(rays.size());
    std::vector<TraversalCounts> counts(rays.size());
    structure->intersect(rays, hits, counts);
    if (threads == 1) {
      first_nodes = fingerprint(*structure);
      first_hits = hits;
      first_counts = counts;
      continue;
    }
    EXPECT_EQ(fingerprint(*structure), first_nodes) << threads << " threads";
    EXPECT_EQ(counts, first_counts) << threads << " threads";
    for (std::size_t i = 0; i < rays.size(); ++i) EXPECT_TRUE(same_bits(hits[i], first_hits[i]));
  }
}

// A million triangles whose boxes all have their centres in one point: no split can part them, yet depth and time must stay bounded.
TEST_P(EachStructure, BuildsAMillionPrimitivesInOnePoint) {
  const std::vector<Vec3> vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const auto mesh = std::make_shared<const TriangleMesh>(vertices, std::vector<Triangle>(1000000, Triangle(0, 1, 2)));
  const auto structure = build(GeometryPointer(mesh), GetParam());
  EXPECT_LE(structure->statistics().depth, 64U);
  const Hit hit = structure->intersect(Ray{{0.25F, 0.25F, 1.0F}, 0.0F, {0.0F, 0.0F, -1.0F}});
  EXPECT_EQ(hit.t, 1.0F);
  EXPECT_EQ(hit.primitive, 0U);
}

INSTANTIATE_TEST_SUITE_P(All, EachStructure, testing::ValuesIn(built_specs()), [](const auto& test) { return as_test_name(test.param); });

}  // namespace
}  // namespace grove::test
