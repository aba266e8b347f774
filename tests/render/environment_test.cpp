#include <gtest/gtest.h>

#include <cmath>

#include "grove/base/random.h"
#include "grove/render/light/environment_light.h"
#include "grove/render/light/environment_mapping.h"
#include "grove/render/sampling/warp.h"
#include "statistics.h"

namespace grove {
namespace {

constexpr std::uint64_t kSeed = 4711;

class Mapping : public ::testing::TestWithParam<EnvironmentMapping> {
 protected:
  // Dim noise with a small sun.
  [[nodiscard]] EnvironmentLight make_light() const {
    auto image = std::make_shared<Image>();
    image->width = GetParam() == EnvironmentMapping::octahedral ? 24 : 32;
    image->height = GetParam() == EnvironmentMapping::octahedral ? 24 : 16;
    image->channels = 3;
    Random random(kSeed);
    for (std::uint32_t i = 0; i < image->width * image->height * 3; ++i) image->floats.push_back(random.next_float(0.0F, 0.3F));
    for (std::uint32_t c = 0; c < 3; ++c) image->floats[(7 * image->width + 11) * 3 + c] = 60.0F;
    Environment environment;
    environment.radiance = Vec3(1.0F, 0.5F, 2.0F);
    environment.mapping = GetParam();
    const float a = 0.7F;
    environment.world_to_environment = Mat3(Vec3(std::cos(a), 0, std::sin(a)), Vec3(0, 1, 0), Vec3(-std::sin(a), 0, std::cos(a)));
    return {environment, image};
  }
};

INSTANTIATE_TEST_SUITE_P(Mappings, Mapping, ::testing::Values(EnvironmentMapping::equirectangular, EnvironmentMapping::octahedral),
                         [](const auto& which) {
                           return std::string(which.param == EnvironmentMapping::octahedral ? "octahedral" : "equirectangular");
                         });

TEST_P(Mapping, GoesThereAndBack) {
  Random random(kSeed);
  for (int i = 0; i < 5000; ++i) {
    const Vec3 w = sample_sphere({random.next_float(), random.next_float()});
    const Vec2 uv = environment_uv(GetParam(), w);
    ASSERT_TRUE(uv.x >= 0.0F && uv.x <= 1.0F && uv.y >= 0.0F && uv.y <= 1.0F);
    ASSERT_NEAR(glm::length(environment_direction(GetParam(), uv) - w), 0.0F, 2e-3F) << "seed " << kSeed << ", direction " << i;
  }
  for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)}) {
    EXPECT_NEAR(glm::length(environment_direction(GetParam(), environment_uv(GetParam(), axis)) - axis), 0.0F, 1e-3F);
  }
}

TEST_P(Mapping, AreaPerSolidAngleIsTheJacobian) {
  Random random(kSeed);
  for (int i = 0; i < 300; ++i) {
    const Vec2 uv(random.next_float(0.05F, 0.95F), random.next_float(0.05F, 0.95F));
    // Away from the seams of the octahedral square.
    const float on_axis = std::min(std::fabs(uv.x - 0.5F), std::fabs(uv.y - 0.5F));
    const float on_diamond = std::fabs(std::fabs(uv.x - 0.5F) + std::fabs(uv.y - 0.5F) - 0.5F);
    if (on_axis < 0.02F || on_diamond < 0.02F) continue;
    const float step = 0.005F;
    const Vec3 du = environment_direction(GetParam(), uv + Vec2(step, 0)) - environment_direction(GetParam(), uv - Vec2(step, 0));
    const Vec3 dv = environment_direction(GetParam(), uv + Vec2(0, step)) - environment_direction(GetParam(), uv - Vec2(0, step));
    const float solid_angle = glm::length(glm::cross(du, dv)) / (4.0F * step * step);
    const float ratio = environment_area_per_solid_angle(GetParam(), environment_direction(GetParam(), uv)) * solid_angle;
    ASSERT_NEAR(ratio, 1.0F, 0.02F) << uv.x << ", " << uv.y;
  }
}

TEST_P(Mapping, SamplesMatchTheDensity) {
  const EnvironmentLight light = make_light();
  constexpr int kAzimuths = 20;
  constexpr int kCosines = 20;
  constexpr int kSub = 40;
  constexpr int kDraws = 50000;
  std::vector<double> expected(kAzimuths * kCosines);
  double total = 0.0;
  for (int cell = 0; cell < kAzimuths * kCosines; ++cell) {
    double sum = 0.0;
    for (int i = 0; i < kSub * kSub; ++i) {
      const Vec2 u((static_cast<float>(cell % kCosines) + (static_cast<float>(i % kSub) + 0.5F) / kSub) / kCosines,
                   (static_cast<float>(cell / kCosines) + (static_cast<float>(i / kSub) + 0.5F) / kSub) / kAzimuths);
      sum += static_cast<double>(light.pdf(sample_sphere(u)));
    }
    const double mass = sum / (kSub * kSub) * 4.0 * static_cast<double>(kPi) / (kAzimuths * kCosines);
    total += mass;
    expected[static_cast<std::size_t>(cell)] = mass * kDraws;
  }
  EXPECT_NEAR(total, 1.0, 0.01);
  Random random(kSeed);
  int border_draws = 0;  // rounding may put the direction into the next cell
  std::vector<double> observed(expected.size());
  for (int i = 0; i < kDraws; ++i) {
    const EnvironmentLight::Sample sample = light.sample({random.next_float(), random.next_float()});
    ASSERT_GT(sample.pdf, 0.0F);
    if (std::fabs(sample.pdf - light.pdf(sample.direction)) > 0.02F * sample.pdf) ++border_draws;
    float azimuth = std::atan2(sample.direction.y, sample.direction.x) / (2.0F * kPi);
    if (azimuth < 0.0F) azimuth += 1.0F;
    const int c = std::min(kCosines - 1, static_cast<int>(0.5F * (1.0F - sample.direction.z) * kCosines));
    const int a = std::min(kAzimuths - 1, static_cast<int>(azimuth * kAzimuths));
    ++observed[static_cast<std::size_t>(a * kCosines + c)];
  }
  EXPECT_LT(border_draws, kDraws / 1000);
  EXPECT_GT(testing::chi_squared_fit(observed, expected), 1e-5) << "seed " << kSeed;
}

// Importance sampling and uniform sampling integrate the same light; the sun makes the former far better.
TEST_P(Mapping, LightIntegratesTheSameEitherWay) {
  const EnvironmentLight light = make_light();
  Random random(kSeed);
  double uniform = 0.0;
  double important = 0.0;
  constexpr int kUniform = 400000;
  constexpr int kImportant = 20000;
  for (int i = 0; i < kUniform; ++i) {
    uniform +=
        static_cast<double>(light.radiance(sample_sphere({random.next_float(), random.next_float()})).y) * 4.0 * 3.14159265 / kUniform;
  }
  for (int i = 0; i < kImportant; ++i) {
    const EnvironmentLight::Sample sample = light.sample({random.next_float(), random.next_float()});
    important += static_cast<double>(sample.radiance.y / sample.pdf) / kImportant;
  }
  EXPECT_NEAR(important / uniform, 1.0, 0.05) << "seed " << kSeed;
}

TEST(EnvironmentMapping, PicturesAreTheRightWayUp) {
  using enum EnvironmentMapping;
  EXPECT_NEAR(environment_uv(equirectangular, {0, 1, 0}).y, 0.0F, 1e-6F);
  EXPECT_NEAR(glm::length(environment_uv(equirectangular, {0, 0, -1}) - Vec2(0.5F, 0.5F)), 0.0F, 1e-6F);
  EXPECT_NEAR(environment_uv(equirectangular, {1, 0, 0}).x, 0.75F, 1e-6F);
  EXPECT_NEAR(glm::length(environment_uv(octahedral, {0, 0, 1}) - Vec2(0.5F, 0.5F)), 0.0F, 1e-6F);
  EXPECT_NEAR(glm::length(environment_uv(octahedral, {1, 0, 0}) - Vec2(1.0F, 0.5F)), 0.0F, 1e-6F);
  EXPECT_NEAR(glm::length(environment_uv(octahedral, {0, 1, 0}) - Vec2(0.5F, 1.0F)), 0.0F, 1e-6F);
}

TEST(DefaultSky, IsBrighterAbove) {
  const EnvironmentLight sky = make_default_sky();
  EXPECT_GT(sky.radiance({0, 1, 0}).y, 2.0F * sky.radiance({0, -1, 0}).y);
  EXPECT_TRUE(sky.is_on());
}

}  // namespace
}  // namespace grove
