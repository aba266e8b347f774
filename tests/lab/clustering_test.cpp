#include "grove/lab/clustering.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "grove/base/random.h"
#include "grove/scene/load.h"

namespace grove {
namespace {

std::vector<Vec3> uniform(std::size_t count, const Vec3& size) {
  Random random(3);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    const float x = random.next_float();
    const float y = random.next_float();
    points.push_back(size * Vec3(x, y, random.next_float()));
  }
  return points;
}

// Within four standard errors, of which one is 0.033 on a line, half of it in a plane, and a third in space.
TEST(Clustering, IsOneForRandomPoints) {
  EXPECT_NEAR(*clustering_of(uniform(50000, Vec3(1.0F))), 1.0, 0.045);
  // Also in a flat box, on a line, far from the origin, and in any unit of length.
  EXPECT_NEAR(*clustering_of(uniform(50000, Vec3(4.0F, 0.0F, 1.0F))), 1.0, 0.066);
  EXPECT_NEAR(*clustering_of(uniform(50000, Vec3(0.0F, 0.0F, 7.0F))), 1.0, 0.13);
  EXPECT_NEAR(*clustering_of(uniform(50000, Vec3(1e37F))), 1.0, 0.045);
  EXPECT_NEAR(*clustering_of(uniform(50000, Vec3(1e-37F))), 1.0, 0.045);
}

TEST(Clustering, IsLowOnALatticeAndHighInClusters) {
  std::vector<Vec3> lattice;
  for (int i = 0; i < 20 * 20 * 20; ++i) lattice.emplace_back(i % 20, i / 20 % 20, i / 400);
  EXPECT_LT(*clustering_of(lattice), 0.6);
  Random random(4);
  std::vector<Vec3> clusters;
  for (const Vec3& step : uniform(20000, Vec3(0.02F)))
    clusters.push_back(step + Vec3(random.next_u32(3), random.next_u32(3), random.next_u32(3)));
  EXPECT_GT(*clustering_of(clusters), 50.0);
}

TEST(Clustering, NeedsTwoPlaces) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(clustering_of(std::vector<Vec3>()));
  EXPECT_FALSE(clustering_of(std::vector<Vec3>(5, Vec3(1.0F))));
  EXPECT_FALSE(clustering_of(std::vector<Vec3>{Vec3(1.0F), Vec3(nan, 0.0F, 0.0F)}));
  const double two = *clustering_of(std::vector<Vec3>{Vec3(0.0F), Vec3(1.0F), Vec3(nan)});
  EXPECT_GT(two, 0.0);
  EXPECT_LT(two, 1.0);
}

TEST(Clustering, OfScenesTellsLayoutsApart) {
  EXPECT_NEAR(*clustering_of(load_scene("builtin:spheres?primitives=5000")), 1.0, 0.045);
  EXPECT_GT(*clustering_of(load_scene("builtin:spheres?primitives=5000&layout=clustered")), 3.0);
  EXPECT_FALSE(clustering_of(Scene()));
}

}  // namespace
}  // namespace grove
