#include <gtest/gtest.h>

#include <cmath>

#include "grove/base/random.h"
#include "grove/render/light/light_choice.h"
#include "grove/render/light/light_table.h"
#include "grove/render/scene_accelerator.h"
#include "test_scenes.h"

namespace grove {
namespace {

using testing::SceneMaker;

constexpr std::uint64_t kSeed = 5150;

// 100 groups of three lights, and one infinitely far.
LightChoice many_lights(std::vector<float>& power) {
  std::vector<LightChoice::Group> groups;
  Random random(kSeed);
  for (std::uint32_t g = 0; g < 100; ++g) {
    LightChoice::Group group{.first = g * 3, .count = 3, .box = {}, .strength = 0.0F};
    group.box.grow(Vec3(static_cast<float>(g), 0.0F, 0.0F));
    group.box.grow(Vec3(static_cast<float>(g) + 0.5F, 1.0F, 0.0F));
    for (int i = 0; i < 3; ++i) {
      power.push_back(random.next_float(0.1F, 1.0F));
      group.strength += power.back();
    }
    groups.push_back(group);
  }
  groups.push_back({.first = 300, .count = 1, .box = {}, .strength = 2.0F});
  power.push_back(2.0F);
  return {groups, power};
}

TEST(LightChoice, ChancesSumToOneAndMatchWhatIsChosen) {
  std::vector<float> power;
  const LightChoice choice = many_lights(power);
  for (const Vec3& from : {Vec3(20.0F, 3.0F, 1.0F), Vec3(-500.0F, 0.0F, 0.0F), Vec3(50.25F, 0.5F, 0.0F)}) {
    double sum = 0.0;
    for (std::uint32_t i = 0; i < power.size(); ++i) {
      EXPECT_GT(choice.probability(from, i), 0.0F);
      sum += static_cast<double>(choice.probability(from, i));
    }
    EXPECT_NEAR(sum, 1.0, 1e-4);
    std::vector<double> drawn(power.size());
    constexpr int kSteps = 200000;
    for (int i = 0; i < kSteps; ++i) {
      const LightChoice::Choice chosen = choice.choose(from, (static_cast<float>(i) + 0.5F) / kSteps);
      ASSERT_NEAR(chosen.probability, choice.probability(from, chosen.light), 1e-6F);
      drawn[chosen.light] += 1.0 / kSteps;
    }
    for (std::uint32_t i = 0; i < power.size(); ++i) EXPECT_NEAR(drawn[i], choice.probability(from, i), 1e-3);
  }
}

TEST(LightChoice, PrefersWhatIsNearAndFacesThePoint) {
  LightChoice::Group a{.first = 0, .count = 1, .box = {}, .strength = 1.0F};
  a.box.grow(Vec3(0.0F));
  LightChoice::Group b{.first = 1, .count = 1, .box = {}, .strength = 1.0F};
  b.box.grow(Vec3(10.0F, 0.0F, 0.0F));
  const std::vector<float> power = {1.0F, 1.0F};
  EXPECT_GT(LightChoice({a, b}, power).probability({1, 0, 0}, 0), 0.85F);
  EXPECT_GT(LightChoice({a, b}, power).probability({9, 0, 0}, 1), 0.85F);
  a.is_planar = true;
  a.normal = {-1, 0, 0};
  EXPECT_GT(LightChoice({a, b}, power).probability({1, 0, 0}, 1), 0.85F);
}

// The density that a sample was made with is the one that a hit of the same place is weighed with.
TEST(LightTable, SamplesAndHitsAgreeOnTheDensity) {
  SceneMaker maker;
  const std::uint32_t lamp = maker.material(SceneMaker::lamp(Vec3(3.0F), true));
  maker.quad({-1, 3, -1}, {2, 0, 0}, {0, 0, 2}, lamp);
  maker.quad({4, 0, 0}, {0, 1, 0}, {0, 0, 1}, lamp);
  maker.sphere({{-4, 1, 0}, 0.5F}, lamp);
  maker.sphere({{0, 0, 0}, 1.0F}, lamp, Mat4(Vec4(0.3F, 0.1F, 0, 0), Vec4(0, 0.9F, 0, 0), Vec4(0, 0, 0.5F, 0), Vec4(0, -3, 2, 1)));
  const Scene scene = maker.make();
  const SurfaceTable surfaces(scene);
  const LightTable lights(scene, surfaces);
  const SceneAccelerator accelerator(scene, "bvh");
  Random random(kSeed);
  int compared = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 from(random.next_float(-1, 1), random.next_float(-1, 1), random.next_float(-1, 1));
    const LightSample sample =
        lights.sample(LightReceiver(from), {random.next_float(), random.next_float()}, {random.next_float(), random.next_float()});
    if (!(sample.pdf > 0.0F)) continue;
    Ray ray;
    ray.origin = from;
    ray.direction = sample.direction;
    const Hit hit = accelerator.top().intersect(ray);
    if (!hit) continue;  // the rim of a sphere
    const SurfacePoint point = surfaces.at(ray, hit);
    // What lies in front, or on the far side of the flattened sphere, is another place.
    if (glm::length(point.position - sample.target) > 1e-3F) continue;
    // Near the rim of a sphere the density changes faster than rounding lets a ray aim.
    if (std::fabs(glm::dot(point.geometric_normal, sample.direction)) < 0.1F) continue;
    ++compared;
    const float pdf = lights.pdf_of_hit(LightReceiver(from), hit, point);
    ASSERT_NEAR(pdf, sample.pdf, 0.02F * sample.pdf) << "seed " << kSeed << ", draw " << i;
  }
  EXPECT_GT(compared, 2500);
}

}  // namespace
}  // namespace grove
