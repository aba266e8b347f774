// Rays against volumes: a point of a volume's surface, moved by as much as the primitive tests may be off, must never be missed by the ray
// that is there at exactly that t.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "grove/base/random.h"
#include "grove/traverse/bounding_sphere_test.h"
#include "grove/traverse/oriented_box_test.h"

namespace grove {
namespace {

constexpr double kUnitRoundoff = 0x1p-24;

// In [-1, 1), and often one of the ends or 0.
double coordinate(Random& random) {
  constexpr double kOften[] = {-1.0, 0.0, 1.0};
  return random.next_u32(4) == 0 ? kOften[random.next_u32(3)] : random.next_float(-1.0F, 1.0F);
}

glm::dvec3 direction(Random& random) {
  for (;;) {
    const glm::dvec3 d(coordinate(random), coordinate(random), coordinate(random));
    if (glm::dot(d, d) > 0.01) return glm::normalize(d);
  }
}

// Volumes in unit space of any size and place, from all of the scene to less than a rounding error.
float size(Random& random) {
  return std::ldexp(random.next_float(0.5F, 1.0F), -static_cast<int>(random.next_u32(26)));
}

struct RandomBox {
  OrientedBox volume{};
  glm::dvec3 surface;

  explicit RandomBox(Random& random) {
    const glm::dvec3 u = direction(random);
    const glm::dvec3 v = glm::normalize(glm::cross(u, std::fabs(u.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    const glm::dvec3 axes[3] = {u, v, glm::cross(u, v)};
    const glm::dvec3 centre(random.next_float(-0.5F, 0.5F), random.next_float(-0.5F, 0.5F), random.next_float(-0.5F, 0.5F));
    surface = glm::dvec3(0.0);
    for (int axis = 0; axis < 3; ++axis) {
      for (int component = 0; component < 3; ++component) volume.axes[component][axis] = static_cast<float>(axes[axis][component]);
      const double at = glm::dot(axes[axis], centre);
      const double half = random.next_u32(5) == 0 ? 0.0 : 0.25 * size(random);
      volume.lower[axis] = static_cast<float>(at - half);
      volume.upper[axis] = static_cast<float>(at + half);
      surface += axes[axis] * (at + half * coordinate(random));
    }
  }
};

struct RandomSphere {
  BoundingSphere volume{};
  glm::dvec3 surface;

  explicit RandomSphere(Random& random) {
    volume.centre = Vec3(random.next_float(-0.5F, 0.5F), random.next_float(-0.5F, 0.5F), random.next_float(-0.5F, 0.5F));
    volume.radius = random.next_u32(5) == 0 ? 0.0F : size(random);
    surface = glm::dvec3(volume.centre) + direction(random) * static_cast<double>(volume.radius);
  }
};

// Scenes small, large, far away and flat.
Box scene(Random& random) {
  constexpr float kSizes[] = {1e-41F, 1e-30F, 1.0F, 3.0F, 1e20F, 1e37F};
  const float s = kSizes[random.next_u32(6)];
  const float place = random.next_u32(3) == 0 ? 1e3F * s : 0.0F;
  Box box{Vec3(place), Vec3(place + s)};
  if (random.next_u32(3) == 0) box.upper[static_cast<int>(random.next_u32(3))] -= 0.75F * s;
  return box;
}

struct Case {
  Ray ray;
  float t;
};

// Not inline: GCC 12 may take the double before rounding for the one after it, where it makes vectors of neighbouring lines.
[[gnu::noinline]] Vec3 rounded(const glm::dvec3& v) {
  return Vec3(v);
}

// A ray from outside or inside that is at `point` (in the scene) at t, but for 14 u of the largest coordinate.
Case aim(const Box& bounds, const UnitSpace& space, const glm::dvec3& unit_point, Random& random) {
  const double far = std::ldexp(1.0, static_cast<int>(random.next_u32(12)) - 2);
  Case result;
  glm::dvec3 from = unit_point;
  // Along an axis, or anywhere, or from almost where it goes.
  if (random.next_u32(3) == 0) {
    from[static_cast<int>(random.next_u32(3))] += far;
  } else {
    from += direction(random) * (random.next_u32(6) == 0 ? 1e-6 : far);
  }
  result.ray.origin = rounded(space.centre + from / space.scale);
  result.t = 0.0F;
  if (!result.ray.is_traceable()) return result;  // too far away
  const glm::dvec3 origin(result.ray.origin);
  double largest = 0.0;
  for (int axis = 0; axis < 3; ++axis)
    largest = std::max({largest, std::fabs(bounds.lower[axis] - origin[axis]), std::fabs(bounds.upper[axis] - origin[axis])});
  glm::dvec3 to = space.centre + unit_point / space.scale;
  for (int axis = 0; axis < 3; ++axis) to[axis] += coordinate(random) * 12.0 * kUnitRoundoff * largest;
  // The direction is rounded to floats of a good size, then made longer or shorter; t is a power of two throughout.
  const int exponent = std::ilogb(largest);
  const int longer = std::clamp(static_cast<int>(random.next_u32(200)) - 100, exponent - 120, exponent + 120);
  result.ray.direction = Vec3((to - origin) * std::ldexp(1.0, -exponent)) * std::ldexp(1.0F, longer);
  result.t = std::ldexp(1.0F, exponent - longer);
  return result;
}

template <typename RandomVolume>
void expect_no_miss(std::uint64_t seed) {
  Random random(seed);
  int tested = 0;
  for (int i = 0; i < 400000; ++i) {
    const RandomVolume v(random);
    const Box bounds = scene(random);
    const UnitSpace space(bounds);
    // The volume must lie in the scene, or L says nothing about it.
    const Box unit_bounds = space.to_unit(bounds);
    if (!unit_bounds.contains(Box{Vec3(v.surface), Vec3(v.surface)})) continue;
    Case c = aim(bounds, space, v.surface, random);
    if (!c.ray.is_traceable()) continue;
    ++tested;
    for (const bool is_interval_of_one : {false, true}) {
      if (is_interval_of_one) c.ray.t_min = c.t;
      const UnitRay unit_ray(c.ray, space, bounds);
      const VolumeTest<decltype(v.volume)> test(unit_ray);
      float entry = 0.0F;
      const float limit = unit_ray.distance(c.t);
      ASSERT_TRUE(test(v.volume, limit, entry)) << "seed " << seed << ", case " << i;
      ASSERT_LE(entry, limit);
      ASSERT_LE(static_cast<double>(entry), static_cast<double>(c.t) * unit_ray.rate * (1.0 + 0x1p-20) + 1e-44)
          << "seed " << seed << ", case " << i;
    }
  }
  EXPECT_GT(tested, 50000);
}

TEST(OrientedBoxTest, NeverMissesAPointOfTheBox) {
  expect_no_miss<RandomBox>(1);
}

TEST(BoundingSphereTest, NeverMissesAPointOfTheSphere) {
  expect_no_miss<RandomSphere>(2);
}

// Conservative, but not blind: what passes at a clear distance is left out, and entry distances are right.
TEST(VolumeTests, TellWhatIsMissed) {
  const Box bounds{Vec3(-1.0F), Vec3(0.9F)};
  const UnitSpace space(bounds);
  const OrientedBox box = OrientedBox::aligned(space.to_unit(Box{Vec3(-0.25F), Vec3(0.25F)}));
  const BoundingSphere sphere{Vec3(space.to_unit(Vec3(0.0F))), static_cast<float>(0.25 * space.scale)};
  const auto is_met = [&](const Ray& ray, const auto& volume, float expected_t) {
    const UnitRay unit_ray(ray, space, bounds);
    const VolumeTest<std::remove_cvref_t<decltype(volume)>> test(unit_ray);
    float entry = 0.0F;
    const bool met = test(volume, unit_ray.distance(ray.t_max), entry);
    EXPECT_NEAR(met ? entry : expected_t * unit_ray.rate, expected_t * unit_ray.rate, 1e-4);
    return met;
  };
  for (const float length : {1e-30F, 1.0F, 1e30F}) {
    const Vec3 ahead(0.0F, 0.0F, length);
    EXPECT_TRUE(is_met({{0, 0, -2}, 0.0F, ahead}, box, 1.75F / length));
    EXPECT_TRUE(is_met({{0, 0, -2}, 0.0F, ahead}, sphere, 1.75F / length));
    EXPECT_TRUE(is_met({{0, 0, 0}, 0.0F, ahead}, box, 0.0F));
    EXPECT_TRUE(is_met({{0, 0, 0}, 0.0F, ahead}, sphere, 0.0F));
    EXPECT_TRUE(is_met({{0.24F, 0.24F, -2}, 0.0F, ahead}, box, 1.75F / length));
    EXPECT_FALSE(is_met({{0.24F, 0.24F, -2}, 0.0F, ahead}, sphere, 0.0F));  // past the sphere, through the box's corner
    for (const Ray& ray : {Ray{{0.2501F, 0, -2}, 0.0F, ahead}, Ray{{0, -0.2501F, -2}, 0.0F, ahead}, Ray{{0, 0, 2}, 0.0F, ahead},
                           Ray{{0, 0, -2}, 0.0F, ahead, 1.7499F / length}, Ray{{0, 0, -2}, 2.2501F / length, ahead}}) {
      EXPECT_FALSE(is_met(ray, box, 0.0F));
      EXPECT_FALSE(is_met(ray, sphere, 0.0F));
    }
  }
}

TEST(UnitRay, FromBeyondAllMeasureMeetsEverything) {
  const Box bounds{Vec3(0.0F), Vec3(1.0F)};
  const UnitRay unit_ray({Vec3(3e37F), 1e30F, Vec3(1e-30F, 0.0F, 0.0F), 1e38F}, UnitSpace(bounds), bounds);
  float entry = -1.0F;
  EXPECT_TRUE(VolumeTest<OrientedBox>(unit_ray)(OrientedBox::aligned({Vec3(-1.0F), Vec3(-0.9F)}), unit_ray.distance(0.0F), entry));
  EXPECT_EQ(entry, 0.0F);
  EXPECT_TRUE(VolumeTest<BoundingSphere>(unit_ray)({Vec3(1.0F), 0.0F}, unit_ray.distance(0.0F), entry));
  EXPECT_EQ(entry, 0.0F);
}

}  // namespace
}  // namespace grove
