#include "grove/lab/recorded_rays.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cstring>

#include "grove/render/camera_rays.h"
#include "grove/render/record_rays.h"
#include "grove/render/render.h"
#include "lab/small_scene.h"

namespace grove {
namespace {

std::vector<RaySet> sets_of(std::string_view spec, std::size_t count, int threads) {
  const Scene scene = testing::small_scene();
  const SceneAccelerator accelerator(scene, spec);
  oneapi::tbb::task_arena arena(threads);
  return arena.execute([&] { return recorded_rays(scene, accelerator, workload_camera(scene, ""), {count, 1}); });
}

bool are_equal(const std::vector<RaySet>& a, const std::vector<RaySet>& b) {
  return std::ranges::equal(a, b, [](const RaySet& x, const RaySet& y) {
    return x.name == y.name && x.closest_count == y.closest_count && x.size() == y.size() &&
           std::memcmp(x.rays.data(), y.rays.data(), x.size() * sizeof(Ray)) == 0;
  });
}

TEST(RecordedRays, DependOnNeitherThreadsNorStructure) {
  const std::vector<RaySet> sets = sets_of("bvh", 5000, 1);
  EXPECT_TRUE(are_equal(sets, sets_of("bvh", 5000, 3))) << "threads change the rays";
  EXPECT_TRUE(are_equal(sets, sets_of("kdtree", 5000, 2))) << "the structure changes the rays";
}

TEST(RecordedRays, AreSampledDownAndSharedByTheBounces) {
  const std::vector<RaySet> sets = sets_of("bvh", 5000, 2);
  ASSERT_GE(sets.size(), 3U);
  EXPECT_EQ(sets[0].name, "recorded");
  EXPECT_EQ(sets[0].size(), 5000U);
  EXPECT_EQ(sets[1].name, "recorded-0");
  EXPECT_EQ(sets[1].closest_count, sets[1].size()) << "cameras ask for closest hits";
  EXPECT_EQ(sets[2].name, "recorded-1");
  EXPECT_GT(sets[2].closest_count, 0U);
  EXPECT_LT(sets[2].closest_count, sets[2].size()) << "no ray from the first surface goes to a light";
  std::size_t sum = 0;
  std::size_t closest = 0;
  for (std::size_t i = 1; i < sets.size(); ++i) {
    sum += sets[i].size();
    closest += sets[i].closest_count;
  }
  EXPECT_EQ(sum, sets[0].size());
  EXPECT_EQ(closest, sets[0].closest_count);
}

TEST(RecordRays, AreAllThatARenderTraces) {
  const Scene scene = testing::instanced_scene();
  const SceneAccelerator accelerator(scene, "bvh");
  RenderSettings settings;
  settings.width = 40;
  settings.height = 30;
  settings.samples_per_pixel = 1;
  settings.seed = 7;
  const RenderResult picture = render(scene, accelerator, settings);
  const Camera camera = frame_bounds(scene.bounds(), 40.0F / 30.0F);
  const std::vector<RecordedRay> rays = record_rays(scene, accelerator, camera, {40, 30, settings.max_depth, settings.seed});
  EXPECT_EQ(rays.size(), picture.rays_traced);
  EXPECT_EQ(std::ranges::count(rays, 0U, &RecordedRay::bounce), 40 * 30) << "nothing here lets camera rays pass";
}

}  // namespace
}  // namespace grove
