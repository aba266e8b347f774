#include "grove/lab/workload.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/task_arena.h>

#include <cmath>
#include <cstring>

#include "grove/base/error.h"
#include "lab/small_scene.h"

namespace grove {
namespace {

Camera inside_camera() {
  return look_at({0.5F, 0.5F, 0.95F}, {0.5F, 0.45F, 0.0F}, {0.0F, 1.0F, 0.0F}, 1.0F);
}

std::vector<Ray> rays_of(RayKind kind, std::string_view spec, std::uint64_t seed, int threads) {
  const Scene scene = testing::instanced_scene();
  const SceneAccelerator accelerator(scene, spec);
  oneapi::tbb::task_arena arena(threads);
  return arena.execute([&] { return make_rays(kind, scene, accelerator, inside_camera(), {10'000, seed}); });
}

bool are_equal(const std::vector<Ray>& a, const std::vector<Ray>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Ray)) == 0;
}

class WorkloadOfKind : public ::testing::TestWithParam<RayKind> {};

TEST_P(WorkloadOfKind, DependsOnTheSeedAlone) {
  const std::vector<Ray> rays = rays_of(GetParam(), "bvh", 1, 1);
  EXPECT_TRUE(are_equal(rays, rays_of(GetParam(), "bvh", 1, 2))) << "threads change the rays";
  EXPECT_TRUE(are_equal(rays, rays_of(GetParam(), "brute", 1, 1))) << "the structure changes the rays";
  EXPECT_FALSE(are_equal(rays, rays_of(GetParam(), "bvh", 2, 1))) << "the seed does not change the rays";
}

TEST_P(WorkloadOfKind, RaysAreTraceable) {
  for (const Ray& ray : rays_of(GetParam(), "bvh", 1, 2)) {
    ASSERT_TRUE(ray.is_traceable());
    ASSERT_NEAR(glm::length(ray.direction), 1.0F, 1e-4F);
  }
}

INSTANTIATE_TEST_SUITE_P(All, WorkloadOfKind, ::testing::ValuesIn(ray_kinds().begin(), ray_kinds().end()),
                         [](const auto& test) { return std::string(name_of(test.param)); });

TEST(Workload, SamplesOfAPixelFollowEachOther) {
  const Scene scene = testing::small_scene();
  const SceneAccelerator accelerator(scene, "bvh");
  // 32 x 32 pixels of an angle of 57 degrees.
  const std::vector<Ray> rays = make_rays(RayKind::primary, scene, accelerator, inside_camera(), {16 * 1024, 1, 16});
  const auto turn = [&](std::size_t i, std::size_t j) { return glm::length(rays[i].direction - rays[j].direction); };
  for (std::size_t i = 1; i < rays.size(); ++i) ASSERT_LT(turn(i, i - i % 16), 0.06F) << i;
  EXPECT_GT(turn(0, 31 * 16), 0.5F) << "from left to right";
  EXPECT_GT(turn(0, 31 * 32 * 16), 0.5F) << "from top to bottom";
}

TEST(Workload, SurfaceRaysDoNotFindTheirOwnSurface) {
  const Scene scene = testing::small_scene();
  const SceneAccelerator accelerator(scene, "bvh");
  const std::vector<Ray> rays = make_rays(RayKind::diffuse, scene, accelerator, inside_camera(), {10'000, 1});
  std::vector<Hit> hits(rays.size());
  trace(accelerator.top(), Query::closest, rays, hits);
  std::size_t close = 0;
  for (const Hit& hit : hits) {
    EXPECT_TRUE(hit) << "a ray has left the closed box";
    close += hit.t < 1e-6F ? 1 : 0;
  }
  EXPECT_EQ(close, 0U);
}

TEST(Workload, ShadowRaysAreSegmentsOfATenthOfTheDiagonal) {
  const Scene scene = testing::small_scene();
  const SceneAccelerator accelerator(scene, "bvh");
  for (const Ray& ray : make_rays(RayKind::shadow, scene, accelerator, inside_camera(), {100, 1})) {
    EXPECT_NEAR(ray.t_max, 0.1F * std::sqrt(3.0F), 1e-3F);
  }
}

TEST(Workload, RandomRaysFillTheBoundsAndALittleMore) {
  Box box;
  Vec3 mean(0.0F);
  const Scene scene = testing::small_scene();
  const SceneAccelerator accelerator(scene, "bvh");
  for (const Ray& ray : make_rays(RayKind::random, scene, accelerator, inside_camera(), {100'000, 1})) {
    box.grow(ray.origin);
    mean += ray.direction / 100'000.0F;
  }
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(box.lower[axis], -0.1F, 1e-3F);
    EXPECT_NEAR(box.upper[axis], 1.1F, 1e-3F);
    // The mean of n uniform directions has a standard deviation of 1 / sqrt(3 n) on each axis: 0.0018.
    EXPECT_NEAR(mean[axis], 0.0F, 0.01F);
  }
}

TEST(Workload, WithoutAnythingInViewStartsAtWhatRandomRaysMeet) {
  const Scene scene = testing::small_scene();
  const SceneAccelerator accelerator(scene, "bvh");
  const Camera away = look_at({0.5F, 0.5F, 5.0F}, {0.5F, 0.5F, 9.0F}, {0.0F, 1.0F, 0.0F}, 0.5F);
  EXPECT_EQ(make_rays(RayKind::diffuse, scene, accelerator, away, {1000, 1}).size(), 1000U);
}

TEST(Workload, NamesRoundTripAndUnknownOnesListTheKinds) {
  for (const RayKind kind : ray_kinds()) EXPECT_EQ(parse_ray_kind(name_of(kind)), kind);
  try {
    static_cast<void>(parse_ray_kind("caustic"));
    FAIL() << "nothing was thrown";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("primary, diffuse, shadow, random"));
  }
}

}  // namespace
}  // namespace grove
