#include "grove/lab/batch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "grove/lab/workload.h"
#include "grove/registry/registry.h"
#include "lab/small_scene.h"

namespace grove {
namespace {

std::vector<Ray> random_rays(std::size_t count) {
  Random random(9);
  std::vector<Ray> rays(count);
  for (Ray& ray : rays) {
    for (int axis = 0; axis < 3; ++axis) {
      ray.origin[axis] = random.next_float(-1.0F, 2.0F);
      ray.direction[axis] = random.next_float(-1.0F, 1.0F);
    }
  }
  return rays;
}

// One ray more than a whole number of batches, and none at all.
class Batch : public ::testing::TestWithParam<std::size_t> {};

TEST_P(Batch, ClosestHitsAreThoseOfSingleRays) {
  const SceneAccelerator accelerator(testing::small_scene(), "bvh");
  const std::vector<Ray> rays = random_rays(GetParam());
  std::vector<Hit> hits(rays.size());
  trace(accelerator.top(), Query::closest, rays, hits);
  for (std::size_t i = 0; i < rays.size(); ++i) EXPECT_EQ(hits[i], accelerator.top().intersect(rays[i])) << i;
}

TEST_P(Batch, AnyHitsSayWhereSomethingIsHit) {
  const SceneAccelerator accelerator(testing::small_scene(), "bvh");
  const std::vector<Ray> rays = random_rays(GetParam());
  std::vector<Hit> hits(rays.size(), Hit{1.0F, 2.0F, 3.0F, 4, 5, 6});
  trace(accelerator.top(), Query::any, rays, hits);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    Hit expected;
    if (accelerator.top().intersect(rays[i])) expected.t = 0.0F;
    EXPECT_EQ(hits[i], expected) << i;
  }
}

TEST_P(Batch, CountsAreThoseOfAllRays) {
  const SceneAccelerator accelerator(testing::small_scene(), "brute");
  const std::vector<Ray> rays = random_rays(GetParam());
  std::vector<Hit> hits(rays.size());
  const TraversalCounts counts = trace_counted(accelerator.top(), Query::closest, rays, hits);
  EXPECT_EQ(counts.primitives_tested, 212U * rays.size());
}

INSTANTIATE_TEST_SUITE_P(Sizes, Batch, ::testing::Values(0U, 1U, 1024U, 2049U));

}  // namespace
}  // namespace grove
