// Every registered structure after its geometry has moved: whatever an update chooses to do, hits equal those of brute force over the moved
// geometry, bit for bit.

#include <gtest/gtest.h>
#include <oneapi/tbb/task_arena.h>

#include <cmath>
#include <limits>

#include "grove/base/error.h"
#include "grove/base/random.h"
#include "registry/matrix_geometry.h"
#include "registry/matrix_rays.h"
#include "registry/matrix_specs.h"
#include "registry/oracle.h"

namespace grove::test {
namespace {

constexpr UpdatePolicy kPolicies[] = {UpdatePolicy::automatic, UpdatePolicy::refit, UpdatePolicy::rotate, UpdatePolicy::rebuild};

// Stirs the vertices: each goes around the middle by an angle that depends on how far away it is, and a little astray.
std::vector<Vec3> stirred(std::span<const Vec3> vertices, float turn, float stray, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> moved;
  for (const Vec3& v : vertices) {
    const Vec3 d = v - Vec3(0.5F);
    const float angle = turn * std::sqrt(d.x * d.x + d.z * d.z);
    const Vec3 around(std::cos(angle) * d.x - std::sin(angle) * d.z, d.y, std::sin(angle) * d.x + std::cos(angle) * d.z);
    moved.push_back(Vec3(0.5F) + around + stray * Vec3(random.next_float(), random.next_float(), random.next_float()));
  }
  return moved;
}

// Rotations change depths, rebuilding parts all counts.
void expect_statistics_of_its_nodes(const Accelerator& structure, const UpdateReport& report) {
  const StructureStatistics& statistics = structure.statistics();
  EXPECT_EQ(statistics.expected_cost, report.cost);
  std::uint64_t nodes = 0;
  std::vector<std::uint64_t> depths(statistics.depths.size(), 0);
  structure.visit_nodes([&](const NodeView& node) {
    ++nodes;
    if (node.is_leaf) ++depths.at(node.depth);
  });
  if (nodes == 0) return;  // brute shows none
  EXPECT_EQ(statistics.nodes, nodes);
  EXPECT_EQ(statistics.depths, depths);
}

class UpdateMatrix : public testing::TestWithParam<std::tuple<std::string, UpdatePolicy>> {
 protected:
  [[nodiscard]] static std::string spec() { return std::get<0>(GetParam()); }
  [[nodiscard]] static UpdateSettings settings() { return {std::get<1>(GetParam()), 1e6}; }
};

TEST_P(UpdateMatrix, FollowsTriangles) {
  const auto mesh = std::make_shared<TriangleMesh>(random_triangles(1500, 0.1F, 3));
  const GeometryPointer geometry = std::shared_ptr<const TriangleMesh>(mesh);
  const auto structure = build(geometry, spec());
  for (int step = 1; step <= 3; ++step) {
    mesh->move_vertices(stirred(mesh->vertices(), 1.0F, 0.2F, static_cast<std::uint64_t>(step)));
    const UpdateReport report = structure->update(settings());
    EXPECT_TRUE(std::isfinite(report.cost));
    expect_statistics_of_its_nodes(*structure, report);
    expect_hits_of_brute_force(*structure, geometry, 50);
  }
}

TEST_P(UpdateMatrix, FollowsTrianglesThatCanNoLongerBeHitAndBack) {
  const auto mesh = std::make_shared<TriangleMesh>(random_triangles(200, 0.2F, 4));
  const GeometryPointer geometry = std::shared_ptr<const TriangleMesh>(mesh);
  const auto structure = build(geometry, spec());
  const std::vector<Vec3> good(mesh->vertices().begin(), mesh->vertices().end());
  std::vector<Vec3> bad = good;
  for (std::size_t i = 0; i < bad.size(); i += 17) bad[i].y = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t i = 5; i < bad.size(); i += 29) bad[i].x = 1e38F;
  mesh->move_vertices(bad);
  EXPECT_EQ(structure->update(settings()).method, UpdateMethod::rebuild);
  expect_hits_of_brute_force(*structure, geometry, 51);
  mesh->move_vertices(good);
  EXPECT_EQ(structure->update(settings()).method, UpdateMethod::rebuild);
  expect_hits_of_brute_force(*structure, geometry, 52);
}

TEST_P(UpdateMatrix, FollowsSpheres) {
  Random random(5);
  std::vector<SphereSet::Sphere> spheres;
  for (int i = 0; i < 300; ++i)
    spheres.push_back({{random.next_float(), random.next_float(), random.next_float()}, 0.02F + 0.05F * random.next_float()});
  const auto set = std::make_shared<SphereSet>(spheres);
  const GeometryPointer geometry = std::shared_ptr<const SphereSet>(set);
  const auto structure = build(geometry, spec());
  for (SphereSet::Sphere& sphere : spheres) sphere.centre = 2.0F * Vec3(sphere.centre.z, sphere.centre.x, 0.1F * sphere.centre.y);
  set->move_spheres(spheres);
  static_cast<void>(structure->update(settings()));
  expect_hits_of_brute_force(*structure, geometry, 53);
}

TEST_P(UpdateMatrix, SurvivesVerticesThatFlyApart) {
  const auto mesh = std::make_shared<TriangleMesh>(random_triangles(300, 1e-6F, 6));
  const GeometryPointer geometry = std::shared_ptr<const TriangleMesh>(mesh);
  const auto structure = build(geometry, spec());
  std::vector<Vec3> far(mesh->vertices().begin(), mesh->vertices().end());
  for (Vec3& v : far) v = (v - Vec3(0.5F)) * 5e37F;
  mesh->move_vertices(far);
  static_cast<void>(structure->update(settings()));
  expect_hits_of_brute_force(*structure, geometry, 54);
}

INSTANTIATE_TEST_SUITE_P(All, UpdateMatrix, testing::Combine(testing::ValuesIn(representatives()), testing::ValuesIn(kPolicies)),
                         [](const auto& test) {
                           return as_test_name(std::get<0>(test.param) + "_" + std::string(name_of(std::get<1>(test.param))));
                         });

TEST(Update, DoesNothingToAnEmptyStructure) {
  const auto structure = build(TriangleMesh(), "bvh");
  EXPECT_EQ(structure->update({}).rotations, 0U);
  EXPECT_EQ(structure->statistics().references, 0U);
}

// The larger meshes reach every stage that works in parallel.
class UpdateOfMany : public testing::TestWithParam<UpdatePolicy> {};

TEST_P(UpdateOfMany, IsTheSameForAnyNumberOfThreads) {
  double first_cost = 0.0;
  std::vector<TraversalCounts> first_counts;
  for (const int threads : {1, 2, 3, 8}) {
    oneapi::tbb::task_arena arena(threads);
    arena.execute([&] {
      const auto mesh = std::make_shared<TriangleMesh>(random_triangles(60000, 0.02F, 7));
      const auto structure = build(GeometryPointer(std::shared_ptr<const TriangleMesh>(mesh)), "bvh");
      UpdateReport report;
      for (int step = 0; step < 4; ++step) {
        mesh->move_vertices(stirred(mesh->vertices(), 0.4F, 0.01F, static_cast<std::uint64_t>(step)));
        report = structure->update({GetParam(), 1e6});
      }
      const std::vector<Ray> rays = matrix_rays(GeometryPointer(std::shared_ptr<const TriangleMesh>(mesh)), 20, 8);
      std::vector<Hit> hits(rays.size());
      std::vector<TraversalCounts> counts(rays.size());
      structure->intersect(rays, hits, counts);
      if (threads == 1) {
        first_cost = report.cost;
        first_counts = counts;
      }
      EXPECT_EQ(report.cost, first_cost) << threads << " threads";
      EXPECT_EQ(counts, first_counts) << threads << " threads";
    });
  }
}

INSTANTIATE_TEST_SUITE_P(All, UpdateOfMany, testing::ValuesIn(kPolicies),
                         [](const auto& test) { return std::string(name_of(test.param)); });

std::shared_ptr<TriangleMesh> many() {
  return std::make_shared<TriangleMesh>(random_triangles(20000, 0.02F, 9));
}

TEST(Update, RefitReportsHowCostGrows) {
  const auto mesh = many();
  const auto structure = build(GeometryPointer(std::shared_ptr<const TriangleMesh>(mesh)), "bvh");
  const double built = structure->statistics().expected_cost;
  const UpdateReport still = structure->update({UpdatePolicy::refit, 1e6});
  EXPECT_NEAR(still.cost, built, 1e-4 * built);
  mesh->move_vertices(stirred(mesh->vertices(), 0.0F, 0.3F, 10));
  const UpdateReport moved = structure->update({UpdatePolicy::refit, 1e6});
  EXPECT_EQ(moved.method, UpdateMethod::refit);
  EXPECT_EQ(moved.built_cost, built);
  EXPECT_GT(moved.cost_growth(), 1.5);
}

TEST(Update, RotationsLowerWhatARefitCosts) {
  const auto mesh = many();
  const auto structure = build(GeometryPointer(std::shared_ptr<const TriangleMesh>(mesh)), "bvh");
  mesh->move_vertices(stirred(mesh->vertices(), 3.0F, 0.0F, 11));
  const UpdateReport report = structure->update({UpdatePolicy::rotate, 1e6});
  EXPECT_EQ(report.method, UpdateMethod::rotate);
  EXPECT_GT(report.rotations, 100U);
  EXPECT_LT(report.cost, 0.98 * report.refitted_cost);
}

TEST(Update, ChoosesByWhatTheRaysSave) {
  // Nothing moved: a refit will do, rotations find little.
  const auto mesh = many();
  const auto structure = build(GeometryPointer(std::shared_ptr<const TriangleMesh>(mesh)), "bvh");
  EXPECT_EQ(structure->update({}).method, UpdateMethod::rotate);
  // Everything moved, but hardly a ray will see it.
  const std::vector<Vec3> before(mesh->vertices().begin(), mesh->vertices().end());
  mesh->move_vertices(stirred(before, 6.0F, 0.0F, 12));
  EXPECT_EQ(structure->update({UpdatePolicy::automatic, 1.0}).method, UpdateMethod::rotate);
  // Many rays will.
  EXPECT_EQ(structure->update({UpdatePolicy::automatic, 1e9}).method, UpdateMethod::rebuild);
  // One corner moved: a part is rebuilt.
  std::vector<Vec3> corner(mesh->vertices().begin(), mesh->vertices().end());
  Random random(13);
  const Box all = structure->bounds();
  for (std::size_t i = 0; i + 2 < corner.size(); i += 3) {
    if (!(corner[i].x < 0.25F * all.upper.x && corner[i].y < 0.25F * all.upper.y && corner[i].z < 0.5F * all.upper.z)) continue;
    const Vec3 to = Vec3(0.2F) * Vec3(random.next_float(), random.next_float(), random.next_float());
    const Vec3 by = to - corner[i];
    for (std::size_t k = i; k < i + 3; ++k) corner[k] += by;
  }
  mesh->move_vertices(corner);
  const UpdateReport part = structure->update({UpdatePolicy::automatic, 3e6});
  EXPECT_EQ(part.method, UpdateMethod::partial_rebuild);
  EXPECT_GT(part.rebuilt_references, 0U);
  EXPECT_LT(part.rebuilt_references, mesh->size());
  EXPECT_LT(part.cost, part.refitted_cost);
  expect_hits_of_brute_force(*structure, GeometryPointer(std::shared_ptr<const TriangleMesh>(mesh)), 14);
}

TEST(Update, OfFastIsARefitUntilBuildingAnewPays) {
  for (const char* const spec : {"fast", "fast:nodes=compressed"}) {
    const auto mesh = many();
    const GeometryPointer geometry = std::shared_ptr<const TriangleMesh>(mesh);
    const auto structure = build(geometry, spec);
    const double built = structure->statistics().expected_cost;
    EXPECT_EQ(structure->update({}).method, UpdateMethod::refit) << spec;
    mesh->move_vertices(stirred(mesh->vertices(), 6.0F, 0.0F, 12));
    const UpdateReport refitted = structure->update({UpdatePolicy::automatic, 1.0});
    EXPECT_EQ(refitted.method, UpdateMethod::refit) << spec;
    EXPECT_EQ(refitted.built_cost, built) << spec;
    EXPECT_GT(refitted.cost_growth(), 1.5) << spec;
    expect_hits_of_brute_force(*structure, geometry, 20);
    const StructureQuality worse = structure->measure_quality();
    EXPECT_EQ(structure->update({UpdatePolicy::automatic, 1e9}).method, UpdateMethod::rebuild) << spec;
    const StructureQuality better = structure->measure_quality();
    EXPECT_LT(better.end_point_overlap->value, worse.end_point_overlap->value) << spec;
    EXPECT_LT(*better.sibling_overlap, *worse.sibling_overlap) << spec;
  }
}

// Moving an instance touches the top level alone: the structures that instances refer to are not asked for anything.
class Watched final : public Traceable {
 public:
  explicit Watched(std::unique_ptr<Accelerator> accelerator) : accelerator_(std::move(accelerator)) {}
  [[nodiscard]] Box bounds() const override { return accelerator_->bounds(); }
  [[nodiscard]] Hit closest_hit(const Ray& ray, TraversalCounts* counts) const override {
    ++traced;
    return accelerator_->closest_hit(ray, counts);
  }
  [[nodiscard]] bool any_hit(const Ray& ray, TraversalCounts* counts) const override { return accelerator_->any_hit(ray, counts); }
  [[nodiscard]] Hit closest_hit(const Ray& ray, const HitFilter& filter) const override { return accelerator_->closest_hit(ray, filter); }
  [[nodiscard]] bool any_hit(const Ray& ray, const HitFilter& filter) const override { return accelerator_->any_hit(ray, filter); }
  [[nodiscard]] const StructureStatistics& statistics() const { return accelerator_->statistics(); }

  mutable int traced = 0;

 private:
  std::unique_ptr<Accelerator> accelerator_;
};

TEST(Update, OfInstancesTouchesTheTopLevelOnly) {
  const auto object = std::make_shared<Watched>(build(closed_mesh(3, 0.0F, 15), "bvh"));
  std::vector<InstanceSet::Instance> instances;
  for (int i = 0; i < 50; ++i)
    instances.push_back({object, Transform(glm::mat4(1.0F, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3.0F * static_cast<float>(i), 0, 0, 1))});
  const auto set = std::make_shared<InstanceSet>(std::move(instances));
  const GeometryPointer geometry = std::shared_ptr<const InstanceSet>(set);
  for (const UpdatePolicy policy : kPolicies) {
    const auto top = build(geometry, "bvh");
    const double object_build = object->statistics().build_seconds;
    set->move_instance(7, Transform(glm::mat4(2.0F, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 60.0F, 5.0F, 0, 1)));
    object->traced = 0;
    const UpdateReport report = top->update({policy, 1e6});
    EXPECT_LE(report.rebuilt_references, 50U);
    EXPECT_EQ(object->traced, 0);
    EXPECT_EQ(object->statistics().build_seconds, object_build);
    const Hit hit = top->intersect(Ray{{60.0F, 20.0F, 0.0F}, 0.0F, {0.0F, -1.0F, 0.0F}});
    EXPECT_EQ(hit.instance, 7U);
    expect_hits_of_brute_force(*top, geometry, 16);
    set->move_instance(7, Transform(glm::mat4(1.0F, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 21.0F, 0, 0, 1)));
  }
}

TEST(Update, OfAnObjectIsSeenByTheTopLevelOnceItsBoundsAre) {
  const auto mesh = std::make_shared<TriangleMesh>(closed_mesh(2, 0.0F, 17));
  const std::shared_ptr<Accelerator> object = build(GeometryPointer(std::shared_ptr<const TriangleMesh>(mesh)), "bvh");
  const auto set =
      std::make_shared<InstanceSet>(std::vector<InstanceSet::Instance>{{object, Transform()}, {object, Transform(Mat4(3.0F))}});
  const GeometryPointer geometry = std::shared_ptr<const InstanceSet>(set);
  const auto top = build(geometry, "bvh");
  std::vector<Vec3> moved(mesh->vertices().begin(), mesh->vertices().end());
  for (Vec3& v : moved) v.y += 10.0F;
  mesh->move_vertices(moved);
  static_cast<void>(object->update({}));
  set->refresh_bounds();
  static_cast<void>(top->update({}));
  EXPECT_NEAR(top->intersect(Ray{{0.0F, 20.0F, 0.0F}, 0.0F, {0.0F, -1.0F, 0.0F}}).t, 9.0F, 0.1F);
  expect_hits_of_brute_force(*top, geometry, 18);
}

TEST(Update, MovingMustKeepTheNumberOfPrimitives) {
  TriangleMesh mesh = random_triangles(3, 0.1F, 19);
  EXPECT_THROW(mesh.move_vertices(std::vector<Vec3>(8)), InputError);
  SphereSet set(std::vector<SphereSet::Sphere>(3));
  EXPECT_THROW(set.move_spheres(std::vector<SphereSet::Sphere>(2)), InputError);
}

TEST(Update, PoliciesAreKnownByName) {
  for (const UpdatePolicy policy : kPolicies) EXPECT_EQ(parse_update_policy(name_of(policy)), policy);
  EXPECT_THROW(static_cast<void>(parse_update_policy("reift")), UsageError);
}

}  // namespace
}  // namespace grove::test
