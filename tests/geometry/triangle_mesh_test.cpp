#include "grove/geometry/triangle_mesh.h"

#include <gtest/gtest.h>

#include <limits>

#include "grove/base/error.h"

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

TEST(TriangleMesh, WhatIsNotFiniteHasNoBounds) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, nan, 0}, {infinity, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}});
  EXPECT_TRUE(mesh.bounds(0).is_empty());
  EXPECT_TRUE(mesh.bounds(1).is_empty());
  EXPECT_EQ(mesh.bounds(2).upper, Vec3(1, 1, 0));
  EXPECT_TRUE(mesh.clip(0, {Vec3(-9.0F), Vec3(9.0F)}).is_empty());
}

}  // namespace
}  // namespace grove
