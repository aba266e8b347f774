#include "grove/geometry/instance_set.h"

#include <gtest/gtest.h>

#include <limits>

#include "grove/geometry/geometry_concept.h"

namespace grove {
namespace {

// A square of side 2 around the origin in the plane z = 0 that can be hit from either side.
class Square final : public Traceable {
 public:
  [[nodiscard]] Box bounds() const override { return {{-1, -1, 0}, {1, 1, 0}}; }
  [[nodiscard]] Hit closest_hit(const Ray& ray, TraversalCounts* counts) const override {
    if (counts != nullptr) ++counts->primitives_tested;
    Hit hit;
    const float t = -ray.origin.z / ray.direction.z;
    const Vec3 p = ray.at(t);
    if (!(t >= ray.t_min && t <= ray.t_max && std::abs(p.x) <= 1 && std::abs(p.y) <= 1)) return hit;
    hit.t = t;
    hit.primitive = 7;
    hit.geometry = 2;
    return hit;
  }
  [[nodiscard]] bool any_hit(const Ray& ray, TraversalCounts* counts) const override { return static_cast<bool>(closest_hit(ray, counts)); }
  [[nodiscard]] Hit closest_hit(const Ray& ray, const HitFilter& filter) const override {
    const Hit hit = closest_hit(ray, nullptr);
    return hit && filter(hit) ? hit : Hit{};
  }
  [[nodiscard]] bool any_hit(const Ray& ray, const HitFilter& filter) const override { return static_cast<bool>(closest_hit(ray, filter)); }
};

Mat4 moved(float x, float scale) {
  Mat4 matrix(scale);
  matrix[3] = Vec4(x, 0.0F, 0.0F, 1.0F);
  return matrix;
}

TEST(InstanceSet, KeepsDistancesInWorldUnits) {
  const auto square = std::make_shared<const Square>();
  const InstanceSet set({{square, Transform(moved(10.0F, 3.0F))}});
  const Ray ray{{12.0F, 2.0F, 6.0F}, 0.0F, {0.0F, 0.0F, -2.0F}};
  Hit hit;
  hit.t = ray.t_max;
  TraversalCounts counts;
  Counter counter(counts);
  ASSERT_TRUE(set.intersect(0, InstanceSet::prepare(ray), hit, counter));
  EXPECT_EQ(hit.t, 3.0F);
  EXPECT_EQ(hit.primitive, 7U);
  EXPECT_EQ(hit.geometry, 2U);
  EXPECT_EQ(hit.instance, 0U);
  EXPECT_EQ(counts.primitives_tested, 1U);
  EXPECT_TRUE(set.occluded(0, InstanceSet::prepare(ray), counter));
}

TEST(InstanceSet, EqualDistancesGoToTheLowerInstance) {
  const auto square = std::make_shared<const Square>();
  const InstanceSet set({{square, Transform()}, {square, Transform()}});
  const Ray ray{{0, 0, 1}, 0, {0, 0, -1}};
  NoCounter counter;
  for (const bool backwards : {false, true}) {
    Hit hit;
    hit.t = ray.t_max;
    for (const std::size_t i : {backwards ? 1 : 0, backwards ? 0 : 1}) set.intersect(i, InstanceSet::prepare(ray), hit, counter);
    EXPECT_EQ(hit.instance, 0U);
  }
}

TEST(InstanceSet, WhatCannotBeInvertedIsNeverHit) {
  const auto square = std::make_shared<const Square>();
  Mat4 flat(1.0F);
  flat[0] = Vec4(0.0F);
  Mat4 broken(1.0F);
  broken[3].y = std::numeric_limits<float>::quiet_NaN();
  const InstanceSet set({{square, Transform(flat)}, {square, Transform(broken)}, {nullptr, Transform()}});
  const Ray ray{{0, 0, 1}, 0, {0, 0, -1}};
  NoCounter counter;
  for (std::size_t i = 0; i < set.size(); ++i) {
    Hit hit;
    hit.t = ray.t_max;
    EXPECT_TRUE(set.bounds(i).is_empty());
    EXPECT_FALSE(set.intersect(i, InstanceSet::prepare(ray), hit, counter));
    EXPECT_FALSE(set.occluded(i, InstanceSet::prepare(ray), counter));
  }
}

}  // namespace
}  // namespace grove
