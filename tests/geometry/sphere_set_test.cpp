#include "grove/geometry/sphere_set.h"

#include <gtest/gtest.h>

#include "grove/geometry/sampled_geometry.h"

namespace grove {
namespace {

Hit trace(const SphereSet& set, const Ray& ray) {
  Hit hit;
  hit.t = ray.t_max;
  NoCounter counter;
  for (std::size_t i = 0; i < set.size(); ++i) set.intersect(i, SphereSet::prepare(ray), hit, counter);
  return hit;
}

TEST(SphereSet, HitsFromOutsideAndInside) {
  const SphereSet set({{Vec3(0.0F), 2.0F}});
  EXPECT_EQ(trace(set, {{-5, 0, 0}, 0, {1, 0, 0}}).t, 3.0F);
  EXPECT_EQ(trace(set, {{-5, 0, 0}, 0, {2, 0, 0}}).t, 1.5F);
  EXPECT_EQ(trace(set, {{0, 0, 0}, 0, {1, 0, 0}}).t, 2.0F);
  EXPECT_EQ(trace(set, {{-5, 0, 0}, 3.5F, {1, 0, 0}}).t, 7.0F);
  EXPECT_FALSE(trace(set, {{-5, 0, 0}, 0, {-1, 0, 0}}));
  EXPECT_FALSE(trace(set, {{-5, 2.001F, 0}, 0, {1, 0, 0}}));
  EXPECT_EQ(trace(set, {{-5, 2, 0}, 0, {1, 0, 0}}).t, 5.0F);
}

TEST(SphereSet, StaysRoundFromAfar) {
  // In float the squared distance of 1e5 would swallow the squared radius.
  const SphereSet set({{Vec3(0.0F), 0.01F}});
  EXPECT_TRUE(trace(set, {{-1e5F, 0.0099F, 0}, 0, {1, 0, 0}}));
  EXPECT_FALSE(trace(set, {{-1e5F, 0.0101F, 0}, 0, {1, 0, 0}}));
}

TEST(SphereSet, CoordinatesAreSpherical) {
  const SphereSet set({{Vec3(0.0F), 1.0F}});
  const Hit side = trace(set, {{0, 5, 0}, 0, {0, -1, 0}});
  EXPECT_FLOAT_EQ(side.u, 0.25F);
  EXPECT_FLOAT_EQ(side.v, 0.5F);
  EXPECT_FLOAT_EQ(trace(set, {{0, 0, 5}, 0, {0, 0, -1}}).v, 0.0F);
  EXPECT_FLOAT_EQ(trace(set, {{0, -5, 0}, 0, {0, 1, 0}}).u, 0.75F);
}

TEST(SphereSet, ClipLeavesOutBoxesThatTheSurfaceMisses) {
  const SphereSet set({{Vec3(0.0F), 1.0F}});
  EXPECT_TRUE(set.clip(0, {Vec3(0.6F), Vec3(1.0F)}).is_empty());    // the corner beyond the sphere
  EXPECT_TRUE(set.clip(0, {Vec3(-0.5F), Vec3(0.5F)}).is_empty());   // inside
  EXPECT_FALSE(set.clip(0, {Vec3(0.5F), Vec3(1.0F)}).is_empty());   // the surface passes
  EXPECT_FALSE(set.clip(0, {Vec3(-2.0F), Vec3(2.0F)}).is_empty());  // all of it
}

TEST(SphereSet, GrowsAndKeepsNumbers) {
  SphereSet set({{Vec3(0.0F), 1.0F}});
  const std::vector<SphereSet::Sphere> more(2, {Vec3(1.0F), 2.0F});
  EXPECT_EQ(set.extend_last_part(more), 1U);
  EXPECT_EQ(set.size(), 3U);
  EXPECT_EQ(set.part_count(), 1U);
  set.remove_sphere(0);
  EXPECT_EQ(set.size(), 3U);
  EXPECT_TRUE(set.bounds(0).is_empty());
  EXPECT_FALSE(set.bounds(1).is_empty());
}

TEST(SphereSet, SurfacePointsAreUniform) {
  static_assert(SampledGeometry<SphereSet>);
  const SphereSet set({{Vec3(1, 2, 3), 2.0F}, {Vec3(0.0F), -1.0F}});
  EXPECT_NEAR(set.surface_area(0), 50.26548245743669, 1e-12);
  EXPECT_EQ(set.surface_area(1), 0.0);
  // The variance along each axis is a third of the squared radius.
  constexpr int kSide = 200;
  glm::dvec3 mean(0.0);
  glm::dvec3 variance(0.0);
  for (int i = 0; i < kSide * kSide; ++i) {
    const glm::dvec3 from_centre = set.surface_point(0, (i % kSide + 0.5) / kSide, (i / kSide + 0.5) / kSide) - glm::dvec3(1, 2, 3);
    ASSERT_NEAR(glm::length(from_centre), 2.0, 1e-12);
    mean += from_centre / (1.0 * kSide * kSide);
    variance += from_centre * from_centre / (1.0 * kSide * kSide);
  }
  EXPECT_NEAR(glm::length(mean), 0.0, 1e-3);
  EXPECT_NEAR(glm::length(variance - glm::dvec3(4.0 / 3.0)), 0.0, 1e-3);
}

}  // namespace
}  // namespace grove
