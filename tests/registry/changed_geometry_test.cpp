// Every registered structure after primitives were added, removed and moved, told which or not: hits equal those of brute force over the geometry
// as it has become, bit for bit.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "grove/base/error.h"
#include "grove/base/random.h"
#include "registry/matrix_geometry.h"
#include "registry/matrix_specs.h"
#include "registry/oracle.h"

namespace grove::test {
namespace {

using Ids = std::vector<std::uint32_t>;

Vec3 random_point(Random& random, float side = 1.0F) {
  return side * Vec3(random.next_float(), random.next_float(), random.next_float());
}

// A geometry of each kind that can change. `add` puts primitives somewhere in a cube of the given side.
struct Triangles {
  std::shared_ptr<TriangleMesh> set = std::make_shared<TriangleMesh>(random_triangles(400, 0.1F, 1));
  [[nodiscard]] GeometryPointer pointer() const { return std::shared_ptr<const TriangleMesh>(set); }
  std::uint32_t add(Random& random, float side) const {
    const Vec3 corner = random_point(random, side);
    const std::vector<Vec3> vertices{corner, corner + random_point(random, 0.2F)};
    // The third corner is an old vertex now and then, so that some triangles are large.
    const auto first_vertex = static_cast<std::uint32_t>(set->vertices().size()) - set->first_vertex(part());
    const std::vector<Triangle> triangles{{first_vertex, first_vertex + 1, first_vertex - std::min(first_vertex, 1 + random.next_u32(9))}};
    return set->extend_last_part(vertices, triangles);
  }
  void remove(std::uint32_t i) const { set->remove_triangle(i); }
  void move(std::uint32_t i, Random& random, Ids& changed) const {
    const std::uint32_t vertex = set->triangles()[i].y;
    set->move_vertex(vertex, random_point(random));
    // All that share the vertex have moved.
    for (std::uint32_t k = 0; k < set->size(); ++k) {
      const Triangle& other = set->triangles()[k];
      if (other.x == vertex || other.y == vertex || other.z == vertex) changed.push_back(k);
    }
  }

 private:
  [[nodiscard]] std::uint32_t part() const { return static_cast<std::uint32_t>(set->part_count() - 1); }
};

struct Spheres {
  std::shared_ptr<SphereSet> set = std::make_shared<SphereSet>(std::vector<SphereSet::Sphere>(50, {Vec3(0.5F), 0.2F}));
  [[nodiscard]] GeometryPointer pointer() const { return std::shared_ptr<const SphereSet>(set); }
  std::uint32_t add(Random& random, float side) const {
    const SphereSet::Sphere sphere{random_point(random, side), random.next_float(0.01F, 0.1F)};
    return set->extend_last_part({&sphere, 1});
  }
  void remove(std::uint32_t i) const { set->remove_sphere(i); }
  void move(std::uint32_t i, Random& random, Ids& changed) const {
    set->move_sphere(i, {random_point(random), random.next_float(0.01F, 0.1F)});
    changed.push_back(i);
  }
};

struct Instances {
  std::shared_ptr<const Traceable> object = build(random_triangles(20, 0.4F, 2), "brute");
  std::shared_ptr<InstanceSet> set = std::make_shared<InstanceSet>(std::vector<InstanceSet::Instance>(30, {object, Transform()}));
  [[nodiscard]] GeometryPointer pointer() const { return std::shared_ptr<const InstanceSet>(set); }
  [[nodiscard]] static Transform somewhere(Random& random, float side) {
    Mat4 matrix(random.next_float(0.05F, 0.3F));
    matrix[3] = Vec4(random_point(random, side), 1.0F);
    return Transform(matrix);
  }
  std::uint32_t add(Random& random, float side) const { return set->add_instance({object, somewhere(random, side)}); }
  void remove(std::uint32_t i) const { set->remove_instance(i); }
  void move(std::uint32_t i, Random& random, Ids& changed) const {
    set->move_instance(i, somewhere(random, 1.0F));
    changed.push_back(i);
  }
};

// Changes a geometry step by step. What was removed may be moved, which brings spheres back.
template <typename Changing>
void expect_to_follow(const std::string& spec, bool tells) {
  Changing changing;
  const auto structure = build(changing.pointer(), spec);
  Random random(20);
  for (std::uint64_t step = 0; step < 7; ++step) {
    Ids changed;
    // Every third step adds only, removes only, or does everything; sometimes far outside of what there was.
    const float side = step % 4 == 3 ? 3.0F : 1.0F;
    if (step % 3 != 1)
      for (int i = 0; i < 9; ++i) changed.push_back(changing.add(random, side));
    if (step % 3 != 0) {
      for (int i = 0; i < 9; ++i) {
        changed.push_back(random.next_u32(static_cast<std::uint32_t>(changing.set->size())));
        changing.remove(changed.back());
      }
    }
    if (step % 3 == 2)
      for (int i = 0; i < 9; ++i) changing.move(random.next_u32(static_cast<std::uint32_t>(changing.set->size())), random, changed);
    UpdateSettings settings;
    if (tells) settings.changed = changed;
    static_cast<void>(structure->update(settings));
    EXPECT_EQ(structure->statistics().primitives, changing.set->size());
    expect_hits_of_brute_force(*structure, changing.pointer(), step);
  }
}

class ChangedGeometry : public testing::TestWithParam<std::tuple<std::string, bool>> {
 protected:
  [[nodiscard]] static std::string spec() { return std::get<0>(GetParam()); }
  [[nodiscard]] static bool tells() { return std::get<1>(GetParam()); }
};

TEST_P(ChangedGeometry, OfTrianglesIsFollowed) {
  expect_to_follow<Triangles>(spec(), tells());
}

TEST_P(ChangedGeometry, OfSpheresIsFollowed) {
  expect_to_follow<Spheres>(spec(), tells());
}

TEST_P(ChangedGeometry, OfInstancesIsFollowed) {
  expect_to_follow<Instances>(spec(), tells());
}

TEST_P(ChangedGeometry, MayBecomeEmptyAndFillAgain) {
  Spheres spheres;
  const auto structure = build(spheres.pointer(), spec());
  Random random(21);
  Ids all;
  for (std::uint32_t i = 0; i < spheres.set->size(); ++i) {
    spheres.remove(i);
    all.push_back(i);
  }
  UpdateSettings settings;
  if (tells()) settings.changed = all;
  static_cast<void>(structure->update(settings));
  EXPECT_EQ(structure->statistics().references, 0U);
  EXPECT_TRUE(structure->bounds().is_empty());
  Ids added;
  for (int i = 0; i < 100; ++i) added.push_back(spheres.add(random, 1.0F));
  if (tells()) settings.changed = added;
  static_cast<void>(structure->update(settings));
  expect_hits_of_brute_force(*structure, spheres.pointer(), 22);
}

TEST_P(ChangedGeometry, IsCheckedBeforeAnythingChanges) {
  Spheres spheres;
  const auto structure = build(spheres.pointer(), spec());
  const Ids wrong{3, 50};
  UpdateSettings settings;
  settings.changed = wrong;
  EXPECT_THROW(static_cast<void>(structure->update(settings)), InputError);
  *spheres.set = SphereSet(std::vector<SphereSet::Sphere>(49));
  EXPECT_THROW(static_cast<void>(structure->update({})), InputError);
}

INSTANTIATE_TEST_SUITE_P(All, ChangedGeometry, testing::Combine(testing::ValuesIn(representatives()), testing::Bool()),
                         [](const auto& test) {
                           return as_test_name(std::get<0>(test.param) + (std::get<1>(test.param) ? "_told" : "_not_told"));
                         });

}  // namespace
}  // namespace grove::test
