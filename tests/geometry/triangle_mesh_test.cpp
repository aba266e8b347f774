#include "grove/geometry/triangle_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "grove/base/error.h"
#include "grove/geometry/geometry_concept.h"
#include "grove/geometry/sampled_geometry.h"

namespace grove {
namespace {

const std::vector<Vec3> kCorners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}};

TEST(TriangleMesh, LocatesPrimitivesInTheirParts) {
  TriangleMesh mesh;
  EXPECT_EQ(mesh.add_part(kCorners, {{0, 1, 2}, {1, 2, 3}}), 0U);
  EXPECT_EQ(mesh.add_part(kCorners, {}), 1U);
  EXPECT_EQ(mesh.add_part(kCorners, {{3, 2, 0}}), 2U);
  EXPECT_EQ(mesh.size(), 3U);
  EXPECT_EQ(mesh.first_vertex(2), 8U);
  EXPECT_EQ(mesh.triangles()[2], Triangle(11, 10, 8));
  Hit hit;
  hit.primitive = 1;
  mesh.locate(hit);
  EXPECT_EQ(hit.geometry, 0U);
  EXPECT_EQ(hit.primitive, 1U);
  hit.primitive = 2;
  mesh.locate(hit);
  EXPECT_EQ(hit.geometry, 2U);
  EXPECT_EQ(hit.primitive, 0U);
  Hit miss;
  mesh.locate(miss);
  EXPECT_EQ(miss, Hit{});
}

TEST(TriangleMesh, RefusesIndicesOutOfRangeAndStaysAsItWas) {
  TriangleMesh mesh(kCorners, {{0, 1, 2}});
  EXPECT_THROW(mesh.add_part(kCorners, {{0, 1, 4}}), InputError);
  EXPECT_EQ(mesh.size(), 1U);
  EXPECT_EQ(mesh.part_count(), 1U);
}

TEST(TriangleMesh, ExtendsItsLastPart) {
  TriangleMesh mesh(kCorners, {{0, 1, 2}});
  mesh.add_part(kCorners, {{0, 1, 2}});
  const std::vector<Vec3> more{{5, 5, 5}};
  const std::vector<Triangle> triangles{{0, 4, 3}, {4, 1, 2}};
  EXPECT_EQ(mesh.extend_last_part(more, triangles), 2U);
  EXPECT_EQ(mesh.part_count(), 2U);
  EXPECT_EQ(mesh.triangles()[2], Triangle(4, 8, 7));
  EXPECT_EQ(mesh.bounds(3).upper, Vec3(5.0F));
  const std::vector<Triangle> wrong{{0, 1, 6}};
  EXPECT_THROW(mesh.extend_last_part(more, wrong), InputError);
  EXPECT_EQ(mesh.size(), 4U);
  EXPECT_EQ(mesh.vertices().size(), 9U);
}

TEST(TriangleMesh, WhatIsRemovedCanNotBeHitAndKeepsItsNumber) {
  TriangleMesh mesh(kCorners, {{0, 1, 2}, {1, 2, 3}});
  mesh.remove_triangle(0);
  EXPECT_EQ(mesh.size(), 2U);
  EXPECT_TRUE(mesh.is_removed(0));
  EXPECT_TRUE(mesh.bounds(0).is_empty());
  EXPECT_EQ(mesh.surface_area(0), 0.0);
  EXPECT_FALSE(mesh.bounds(1).is_empty());
  NoCounter counter;
  Hit hit;
  EXPECT_FALSE(mesh.intersect(0, TriangleMesh::prepare(Ray{{0, 0, -1}, 0.0F, {0, 0, 1}}), hit, counter));
}

TEST(TriangleMesh, WhatIsNotFiniteHasNoBounds) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, nan, 0}, {infinity, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}});
  EXPECT_TRUE(mesh.bounds(0).is_empty());
  EXPECT_TRUE(mesh.bounds(1).is_empty());
  EXPECT_EQ(mesh.bounds(2).upper, Vec3(1, 1, 0));
  EXPECT_TRUE(mesh.clip(0, {Vec3(-9.0F), Vec3(9.0F)}).is_empty());
}

// A uniform grid over (u, v) gives points whose mean is the centroid, and a quarter of them in the corner triangle of half the side.
TEST(TriangleMesh, SurfacePointsAreUniform) {
  static_assert(SampledGeometry<TriangleMesh>);
  const TriangleMesh mesh({{1, 2, 3}, {4, 2, 3}, {1, 6, 3}, {1, NAN, 3}}, {{0, 1, 2}, {0, 1, 3}, {0, 0, 1}});
  EXPECT_EQ(mesh.surface_area(0), 6.0);
  EXPECT_EQ(mesh.surface_area(1), 0.0);
  EXPECT_EQ(mesh.surface_area(2), 0.0);
  for (int corner = 0; corner < 3; ++corner) {
    constexpr int kSide = 200;
    glm::dvec3 sum(0.0);
    int in_corner = 0;
    for (int i = 0; i < kSide * kSide; ++i) {
      const glm::dvec3 point = mesh.surface_point(0, (i % kSide + 0.5) / kSide, (i / kSide + 0.5) / kSide);
      const double b1 = (point.x - 1.0) / 3.0;
      const double b2 = (point.y - 2.0) / 4.0;
      ASSERT_EQ(point.z, 3.0);
      ASSERT_GE(std::min({b1, b2, 1.0 - b1 - b2}), -1e-12);
      in_corner += (corner == 0 ? 1.0 - b1 - b2 : corner == 1 ? b1 : b2) > 0.5 ? 1 : 0;
      sum += point;
    }
    EXPECT_NEAR(in_corner / (1.0 * kSide * kSide), 0.25, 0.01) << corner;
    EXPECT_NEAR(glm::length(sum / (1.0 * kSide * kSide) - glm::dvec3(2.0, 10.0 / 3.0, 3.0)), 0.0, 0.01);
  }
}

}  // namespace
}  // namespace grove
