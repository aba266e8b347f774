#include "grove/scene/formats/triangulate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "grove/base/error.h"
#include "grove/base/random.h"

namespace grove {
namespace {

// Twice the area, signed, of the polygon seen from +z.
double polygon_area(const std::vector<Vec3>& p) {
  double sum = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec3& a = p[i];
    const Vec3& b = p[(i + 1) % p.size()];
    sum += static_cast<double>(a.x) * b.y - static_cast<double>(a.y) * b.x;
  }
  return sum;
}

// The triangles cover a simple polygon exactly if none is turned over and their areas sum up to its own.
void expect_tiling(const std::vector<Vec3>& polygon) {
  Triangulator triangulator;
  const auto triangles = triangulator.triangulate(polygon);
  ASSERT_EQ(triangles.size(), polygon.size() - 2);
  const double whole = polygon_area(polygon);
  double sum = 0.0;
  for (const auto& [a, b, c] : triangles) {
    const double area = polygon_area({polygon[a], polygon[b], polygon[c]});
    EXPECT_GE(area / whole, -1e-9);
    sum += area;
  }
  EXPECT_NEAR(sum / whole, 1.0, 1e-6);
}

// Star-shaped around the origin: simple, and as concave as the radii are random.
std::vector<Vec3> random_star(std::uint64_t seed, std::uint32_t corners) {
  Random random(seed);
  std::vector<Vec3> polygon;
  for (std::uint32_t i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + 0.8 * random.next_float()) / corners;
    const float radius = random.next_float(0.1F, 1.0F);
    polygon.emplace_back(radius * static_cast<float>(std::cos(angle)), radius * static_cast<float>(std::sin(angle)), 0.0F);
  }
  return polygon;
}

TEST(Triangulate, TilesRandomStars) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::vector<Vec3> polygon = random_star(seed, 4 + static_cast<std::uint32_t>(seed % 60));
    expect_tiling(polygon);
    std::reverse(polygon.begin(), polygon.end());
    expect_tiling(polygon);
  }
}

TEST(Triangulate, TilesConvexPolygonsWithStraightCorners) {
  expect_tiling({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {0, 2, 0}, {0, 1, 0}});
}

TEST(Triangulate, TilesAnLAndAComb) {
  expect_tiling({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}});
  std::vector<Vec3> comb{{0, 0, 0}, {40, 0, 0}};
  for (int i = 39; i > 0; --i) comb.emplace_back(static_cast<float>(i), i % 2 == 0 ? 10.0F : 1.0F, 0.0F);
  comb.emplace_back(0.0F, 10.0F, 0.0F);
  expect_tiling(comb);
}

TEST(Triangulate, TilesAPolygonWithABridgeToItsHole) {
  expect_tiling({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0}, {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}});
}

TEST(Triangulate, WorksInAnyPlane) {
  Triangulator triangulator;
  std::vector<Vec3> polygon = random_star(7, 30);
  double whole = std::fabs(polygon_area(polygon));
  for (Vec3& p : polygon) p = Vec3(0.3F * p.x + 5.0F, 0.4F * p.x + p.y, 1.2F * p.x - 0.2F * p.y);
  double sum = 0.0;
  for (const auto& [a, b, c] : triangulator.triangulate(polygon))
    sum += glm::length(glm::cross(polygon[b] - polygon[a], polygon[c] - polygon[a]));
  // The area of the image of the unit square under the map above.
  whole *= glm::length(glm::cross(Vec3(0.3F, 0.4F, 1.2F), Vec3(0.0F, 1.0F, -0.2F)));
  EXPECT_NEAR(sum / whole, 1.0, 1e-5);
}

TEST(Triangulate, GivesTheRightNumberForWhatIsNoPolygon) {
  Triangulator triangulator;
  const float nan = std::nanf("");
  EXPECT_TRUE(triangulator.triangulate(std::vector<Vec3>(2)).empty());
  EXPECT_EQ(triangulator.triangulate(std::vector<Vec3>(6)).size(), 4U);
  EXPECT_EQ(triangulator.triangulate(std::vector<Vec3>{{0, 0, 0}, {1, nan, 0}, {1, 1, 0}, {0, 1, 0}}).size(), 2U);
  // A figure of eight, and a pentagram: convex corners only, but twice around.
  EXPECT_EQ(triangulator.triangulate(std::vector<Vec3>{{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 1, 0}}).size(), 2U);
  EXPECT_EQ(triangulator.triangulate(std::vector<Vec3>{{0, 3, 0}, {-2, -3, 0}, {3, 1, 0}, {-3, 1, 0}, {2, -3, 0}}).size(), 3U);
  Random random(3);
  std::vector<Vec3> tangle;
  for (int i = 0; i < 500; ++i) {
    const float x = random.next_float();
    tangle.emplace_back(x, random.next_float(), 0.0F);
  }
  EXPECT_EQ(triangulator.triangulate(tangle).size(), 498U);
}

TEST(Triangulate, RefusesConcavePolygonsBeyondTheLimit) {
  Triangulator triangulator;
  EXPECT_EQ(triangulator.triangulate(random_star(1, 3000)).size(), 2998U);
  EXPECT_THROW((void)triangulator.triangulate(random_star(1, kMaxConcaveCorners + 1)), InputError);
}

}  // namespace
}  // namespace grove
