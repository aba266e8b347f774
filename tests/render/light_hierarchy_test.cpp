#include "grove/render/light/light_hierarchy.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <cmath>
#include <cstring>

#include "grove/base/random.h"
#include "grove/render/bsdf/bsdf_types.h"
#include "grove/render/light/light_selection.h"
#include "grove/render/light/light_table.h"
#include "grove/render/sampling/warp.h"
#include "statistics.h"
#include "test_scenes.h"

namespace grove {
namespace {

using testing::SceneMaker;
using Side = LightReceiver::Side;

constexpr std::uint64_t kSeed = 90125;

Vec3 random_point(Random& random, float half_width) {
  return {random.next_float(-half_width, half_width), random.next_float(-half_width, half_width),
          random.next_float(-half_width, half_width)};
}

Vec3 random_direction(Random& random) {
  return sample_sphere({random.next_float(), random.next_float()});
}

LightReceiver random_receiver(Random& random, float half_width) {
  constexpr Side kSides[] = {Side::any, Side::front, Side::both};
  return {random_point(random, half_width), random_direction(random), kSides[random.next_u32(3)]};
}

// Flat lights with one side and with two, points and spots.
std::vector<LightBounds> mixed_bounds(std::size_t count, Random& random) {
  std::vector<LightBounds> lights(count);
  for (std::size_t i = 0; i < count; ++i) {
    LightBounds& light = lights[i];
    const Vec3 corner = random_point(random, 1.0F);
    light.box.grow(corner);
    light.axis = random_direction(random);
    light.theta_e = 0.5F * kPi;
    light.intensity = random.next_float(0.1F, 1.0F);
    if (i % 4 < 2) {
      light.box.grow(corner + random_point(random, 0.05F));
      light.is_two_sided = i % 4 == 1;
    } else if (i % 4 == 2) {
      light.theta_o = kPi;
    } else {
      light.theta_o = 0.2F;
      light.theta_e = 0.4F;
    }
  }
  return lights;
}

TEST(LightHierarchy, ChancesMatchWhatIsChosen) {
  Random random(kSeed);
  std::vector<LightDescription> lights;
  for (const LightBounds& bounds : mixed_bounds(60, random)) lights.push_back({bounds});
  lights.emplace_back().bounds.intensity = 0.5F;  // a sky
  lights.push_back({.bounds = lights.back().bounds, .direction = {0.0F, 1.0F, 0.0F}});
  const LightSelection selection(LightSampling::hierarchy, lights, {}, 0.0F);
  for (int trial = 0; trial < 30; ++trial) {
    const LightReceiver receiver = random_receiver(random, trial % 2 == 0 ? 1.0F : 4.0F);
    constexpr int kDraws = 20000;
    std::vector<double> expected;
    double sum = 0.0;
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
      expected.push_back(kDraws * static_cast<double>(selection.probability(receiver, i)));
      sum += expected.back();
    }
    std::vector<double> observed(lights.size() + 1);
    for (int i = 0; i < kDraws; ++i) {
      const LightSelection::Choice choice = selection.choose(receiver, {random.next_float(), random.next_float()});
      if (!(choice.probability > 0.0F)) {
        ++observed.back();
        continue;
      }
      ASSERT_NEAR(choice.probability, selection.probability(receiver, choice.light), 1e-6F);
      ++observed[choice.light];
    }
    // What is left of the chances is that of a cluster in which no light can contribute.
    ASSERT_LT(sum, 1.0001 * kDraws);
    if (receiver.side != Side::front) {
      ASSERT_GT(sum, 0.5 * kDraws);
    }
    expected.push_back(std::max(0.0, kDraws - sum));
    EXPECT_GT(testing::chi_squared_fit(observed, expected), 1e-5) << "seed " << kSeed << ", trial " << trial;
  }
}

// Seen from all around by a receiver without a side, lights without axes fill the chances up.
TEST(LightHierarchy, ChancesSumToOneWhereAllLightsShine) {
  Random random(kSeed);
  std::vector<LightBounds> lights = mixed_bounds(500, random);
  for (LightBounds& light : lights) light.theta_o = kPi;
  const LightHierarchy hierarchy(lights);
  EXPECT_EQ(hierarchy.nodes().size(), 999U);
  for (int trial = 0; trial < 20; ++trial) {
    const LightReceiver receiver(random_point(random, 3.0F));
    double sum = 0.0;
    for (std::uint32_t i = 0; i < lights.size(); ++i) sum += static_cast<double>(hierarchy.probability(receiver, i));
    EXPECT_NEAR(sum, 1.0, 1e-4);
  }
}

// Lamps of all kinds, 60 of each, none in the way of another as far as choosing goes.
Scene many_lamps() {
  Random random(kSeed);
  SceneMaker maker;
  const std::uint32_t one_sided = maker.material(SceneMaker::lamp(Vec3(3.0F)));
  const std::uint32_t two_sided = maker.material(SceneMaker::lamp(Vec3(2.0F), true));
  for (int i = 0; i < 60; ++i) {
    const float size = std::exp(random.next_float(-5.0F, 0.0F));
    maker.quad(random_point(random, 2.0F), size * random_direction(random), size * random_direction(random),
               i % 2 == 0 ? one_sided : two_sided);
    maker.sphere({random_point(random, 2.0F), 0.1F * size}, one_sided);
    PunctualLight light;
    light.kind = static_cast<PunctualLightKind>(i % 3);
    if (light.kind == PunctualLightKind::directional && i > 10) light.kind = PunctualLightKind::spot;
    light.position = random_point(random, 2.0F);
    light.direction = random_direction(random);
    light.inner_angle = random.next_float(0.0F, 0.5F);
    light.outer_angle = random.next_float(0.6F, 1.5F);
    maker.scene().lights.push_back(light);
  }
  maker.scene().environment.radiance = Vec3(0.1F);
  return maker.make();
}

// With this and chances that match, estimates are unbiased: a light that can contribute is never out of reach.
TEST(LightHierarchy, NoLightThatContributesIsLeftOut) {
  const Scene scene = many_lamps();
  const SurfaceTable surfaces(scene);
  const LightTable lights(scene, surfaces);
  const LightTable each(scene, surfaces, LightSampling::uniform);
  const auto count = static_cast<float>(each.size());
  Random random(kSeed);
  int contributions = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const LightReceiver receiver = random_receiver(random, trial % 2 == 0 ? 2.5F : 20.0F);
    for (std::uint32_t i = 0; i < each.size(); ++i) {
      const LightSample sample =
          each.sample(receiver, {(static_cast<float>(i) + 0.5F) / count, 0.0F}, {random.next_float(), random.next_float()});
      if (!(sample.pdf > 0.0F) || !(luminance(sample.radiance) > 0.0F)) continue;
      if (receiver.side == Side::front && glm::dot(sample.direction, receiver.normal) <= 0.0F) continue;
      ++contributions;
      ASSERT_GT(lights.chance_of(receiver, i), 0.0F) << "seed " << kSeed << ", trial " << trial << ", light " << i;
    }
  }
  EXPECT_GT(contributions, 30000);
}

// The relative variance of an estimate of the unshadowed irradiance over places on the ground.
double relative_variance(const Scene& scene, LightSampling sampling) {
  const SurfaceTable surfaces(scene);
  const LightTable lights(scene, surfaces, sampling);
  Random random(kSeed);
  double total = 0.0;
  constexpr int kPlaces = 40;
  for (int place = 0; place < kPlaces; ++place) {
    const LightReceiver receiver({random.next_float(-8.0F, 8.0F), 0.0F, random.next_float(-8.0F, 8.0F)}, {0.0F, 1.0F, 0.0F}, Side::front);
    double sum = 0.0;
    double squares = 0.0;
    constexpr int kDraws = 2000;
    for (int i = 0; i < kDraws; ++i) {
      const LightSample sample =
          lights.sample(receiver, {random.next_float(), random.next_float()}, {random.next_float(), random.next_float()});
      if (!(sample.pdf > 0.0F)) continue;
      const auto value = static_cast<double>(luminance(sample.radiance) * std::max(0.0F, sample.direction.y) / sample.pdf);
      sum += value;
      squares += value * value;
    }
    total += squares * kDraws / (sum * sum) - 1.0;
  }
  return total / kPlaces;
}

TEST(LightHierarchy, IsFarLessNoisyThanChoosingByPower) {
  Random random(kSeed);
  SceneMaker maker;
  const std::uint32_t lamp = maker.material(SceneMaker::lamp(Vec3(3.0F)));
  for (int i = 0; i < 500; ++i) {
    const Vec3 corner(random.next_float(-8.0F, 8.0F), random.next_float(0.5F, 3.0F), random.next_float(-8.0F, 8.0F));
    maker.quad(corner, 0.1F * random_direction(random), 0.1F * random_direction(random), lamp);
  }
  const Scene scene = maker.make();
  EXPECT_LT(relative_variance(scene, LightSampling::hierarchy), 0.15 * relative_variance(scene, LightSampling::power));
}

TEST(LightHierarchy, DegenerateSetsAreParted) {
  std::vector<LightBounds> lights;
  // Ever closer to one place, which planes in the middle part one by one; then many at one place.
  for (int i = 0; i < 3000; ++i) {
    LightBounds& light = lights.emplace_back();
    light.box.grow(Vec3(std::ldexp(1.0F, -std::min(i, 120)), 0.0F, 0.0F));
    light.theta_o = kPi;
    light.intensity = 1.0F;
  }
  lights[17].intensity = 0.0F;
  lights[18].box = Box{Vec3(INFINITY), Vec3(INFINITY)};
  const LightHierarchy hierarchy(lights);
  const LightReceiver receiver({0.3F, 0.5F, 0.1F});
  double sum = 0.0;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    const float chance = hierarchy.probability(receiver, i);
    EXPECT_EQ(chance > 0.0F, i != 17 && i != 18) << i;
    sum += static_cast<double>(chance);
  }
  EXPECT_NEAR(sum, 1.0, 1e-4);
  EXPECT_TRUE(LightHierarchy().is_empty());
  EXPECT_EQ(LightHierarchy().choose(receiver, 0.5).probability, 0.0F);
}

TEST(LightHierarchy, DoesNotDependOnThreads) {
  Random random(kSeed);
  const std::vector<LightBounds> lights = mixed_bounds(30000, random);
  const oneapi::tbb::global_control allowed(oneapi::tbb::global_control::max_allowed_parallelism, 4);
  LightHierarchy one;
  LightHierarchy four;
  oneapi::tbb::task_arena(1).execute([&] { one = LightHierarchy(lights); });
  oneapi::tbb::task_arena(4).execute([&] { four = LightHierarchy(lights); });
  ASSERT_EQ(one.nodes().size(), four.nodes().size());
  EXPECT_EQ(std::memcmp(one.nodes().data(), four.nodes().data(), one.nodes().size_bytes()), 0);
}

// Light sampling and hits weighed against each other, in every way of choosing.
TEST(LightHierarchy, AllWaysGiveTheSamePicture) {
  const Scene scene = testing::mixed_scene();
  const SceneAccelerator accelerator(scene, "bvh");
  RenderSettings settings = testing::small_settings(24, 192, 3);
  const float expected = testing::mean_radiance(render(scene, accelerator, settings)).y;
  for (const LightSampling way : {LightSampling::groups, LightSampling::power, LightSampling::uniform}) {
    settings.lights = way;
    EXPECT_NEAR(testing::mean_radiance(render(scene, accelerator, settings)).y, expected, 0.015F * expected)
        << light_sampling_names()[static_cast<std::size_t>(way)];
  }
}

}  // namespace
}  // namespace grove
