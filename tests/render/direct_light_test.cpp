// Light that is scattered once, against closed forms.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "test_scenes.h"

namespace grove {
namespace {

using testing::SceneMaker;

constexpr float kAlbedo = 0.5F;

// Looks straight down at the origin of a large floor, so narrowly that the light there is even.
RenderResult look_at_floor(SceneMaker& maker, std::uint32_t samples) {
  maker.quad({-50, 0, -50}, {0, 0, 100}, {100, 0, 0}, maker.material(SceneMaker::diffuse(Vec3(kAlbedo))));
  maker.camera({0.0F, 0.9F, 0.0F}, {0.0F, 0.0F, 0.0F}, 0.002F, {0.0F, 0.0F, -1.0F});
  return testing::render_scene(maker.make(), testing::small_settings(8, samples, 1));
}

TEST(DirectLight, PointLightFallsWithTheSquare) {
  SceneMaker maker;
  PunctualLight light;
  light.position = {1.5F, 2.0F, 0.0F};
  light.intensity = Vec3(3.0F);
  maker.scene().lights.push_back(light);
  const float distance_squared = 1.5F * 1.5F + 4.0F;
  const float expected = kAlbedo / kPi * 3.0F / distance_squared * (2.0F / std::sqrt(distance_squared));
  EXPECT_NEAR(testing::mean_radiance(look_at_floor(maker, 4)).y, expected, 1e-3F * expected);
}

// The window of KHR_lights_punctual.
TEST(DirectLight, ARangeFadesPointLightsAndSpots) {
  const auto measure = [](PunctualLightKind kind, float range) {
    SceneMaker maker;
    PunctualLight light;
    light.kind = kind;
    light.position = {0.0F, 2.0F, 0.0F};
    light.direction = {0.0F, -1.0F, 0.0F};
    light.intensity = Vec3(4.0F);
    light.range = range;
    maker.scene().lights.push_back(light);
    return testing::mean_radiance(look_at_floor(maker, 4)).y;
  };
  const float full = kAlbedo / kPi * 4.0F / 4.0F;
  for (const PunctualLightKind kind : {PunctualLightKind::point, PunctualLightKind::spot}) {
    EXPECT_NEAR(measure(kind, std::numeric_limits<float>::infinity()), full, 1e-3F * full);
    EXPECT_NEAR(measure(kind, 1e30F), full, 1e-3F * full);
    EXPECT_NEAR(measure(kind, 4.0F), (1.0F - 1.0F / 16.0F) * full, 1e-3F * full);
    EXPECT_NEAR(measure(kind, 2.5F), (1.0F - std::pow(0.8F, 4.0F)) * full, 1e-3F * full);
    EXPECT_EQ(measure(kind, 1.9F), 0.0F);
    EXPECT_EQ(measure(kind, 1e-30F), 0.0F);
  }
  EXPECT_GT(measure(PunctualLightKind::directional, 1.0F), 0.0F) << "comes from infinitely far, whatever the range";
}

TEST(DirectLight, DirectionalLightHasTheCosine) {
  SceneMaker maker;
  PunctualLight light;
  light.kind = PunctualLightKind::directional;
  light.direction = glm::normalize(Vec3(1.0F, -1.0F, 0.0F));
  light.intensity = Vec3(2.0F);
  maker.scene().lights.push_back(light);
  const float expected = kAlbedo / kPi * 2.0F * std::sqrt(0.5F);
  EXPECT_NEAR(testing::mean_radiance(look_at_floor(maker, 4)).y, expected, 1e-3F * expected);
}

TEST(DirectLight, SpotLightEndsAtItsOuterAngle) {
  const auto measure = [](float degrees) {
    SceneMaker maker;
    PunctualLight light;
    light.kind = PunctualLightKind::spot;
    const float angle = degrees * kPi / 180.0F;
    light.position = {0.0F, 2.0F, 0.0F};
    light.direction = {std::sin(angle), -std::cos(angle), 0.0F};
    light.intensity = Vec3(4.0F);
    light.inner_angle = 0.2F;
    light.outer_angle = 0.4F;
    maker.scene().lights.push_back(light);
    return testing::mean_radiance(look_at_floor(maker, 4)).y;
  };
  const float full = kAlbedo / kPi * 4.0F / 4.0F;
  EXPECT_NEAR(measure(5.0F), full, 1e-3F * full);
  EXPECT_EQ(measure(25.0F), 0.0F);
  EXPECT_GT(measure(17.0F), 0.0F);
  EXPECT_LT(measure(17.0F), full);
}

// A square lamp parallel to the floor, centred above: the form factor of a differential element, four quarters (Howell, C-6).
float square_form_factor(float half, float height) {
  const float x = half / height;
  const float s = std::sqrt(1.0F + x * x);
  return 4.0F * (1.0F / (2.0F * kPi)) * 2.0F * (x / s) * std::atan(x / s);
}

TEST(DirectLight, SquareLampMatchesItsFormFactor) {
  for (const float half : {0.1F, 1.0F, 6.0F}) {
    SceneMaker maker;
    // Shines down: cross(x, z) is -y.
    maker.quad({-half, 1.0F, -half}, {2.0F * half, 0, 0}, {0, 0, 2.0F * half}, maker.material(SceneMaker::lamp(Vec3(5.0F))));
    const float expected = kAlbedo * 5.0F * square_form_factor(half, 1.0F);
    EXPECT_NEAR(testing::mean_radiance(look_at_floor(maker, 256)).y, expected, 0.01F * expected) << "half side " << half;
  }
}

TEST(DirectLight, OneSidedLampIsDarkBehind) {
  SceneMaker maker;
  maker.quad({-1, 1, -1}, {0, 0, 2}, {2, 0, 0}, maker.material(SceneMaker::lamp(Vec3(5.0F))));
  EXPECT_EQ(testing::mean_radiance(look_at_floor(maker, 16)).y, 0.0F);
}

// A sphere of radius r at distance d in the zenith: irradiance pi L (r / d)^2.
TEST(DirectLight, SphereLampMatchesItsClosedForm) {
  for (const float radius : {0.05F, 0.5F, 1.2F}) {
    SceneMaker maker;
    maker.sphere({{0.0F, 2.5F, 0.0F}, radius}, maker.material(SceneMaker::lamp(Vec3(7.0F))));
    const float expected = kAlbedo * 7.0F * radius * radius / 6.25F;
    EXPECT_NEAR(testing::mean_radiance(look_at_floor(maker, 256)).y, expected, 0.01F * expected) << "radius " << radius;
  }
}

// The same sphere made by an instance: scaled evenly (sampled by its cone), and a flattened one against its own BSDF-sampled picture.
TEST(DirectLight, InstancedSphereLampsMatch) {
  SceneMaker scaled;
  scaled.sphere({{0.0F, 0.0F, 0.0F}, 1.0F}, scaled.material(SceneMaker::lamp(Vec3(7.0F))),
                Mat4(Vec4(0, 0, 0.5F, 0), Vec4(0.5F, 0, 0, 0), Vec4(0, 0.5F, 0, 0), Vec4(0, 2.5F, 0, 1)));
  const float expected = kAlbedo * 7.0F * 0.25F / 6.25F;
  EXPECT_NEAR(testing::mean_radiance(look_at_floor(scaled, 256)).y, expected, 0.01F * expected);

  // An ellipsoid flattened to height 0 is a disk: irradiance pi L r^2 / (r^2 + d^2).
  SceneMaker flat;
  flat.sphere({{0.0F, 0.0F, 0.0F}, 1.0F}, flat.material(SceneMaker::lamp(Vec3(7.0F))),
              Mat4(Vec4(1, 0, 0, 0), Vec4(0, 0.002F, 0, 0), Vec4(0, 0, 1, 0), Vec4(0, 2.0F, 0, 1)));
  const float disk = kAlbedo * 7.0F / 5.0F;
  EXPECT_NEAR(testing::mean_radiance(look_at_floor(flat, 512)).y, disk, 0.02F * disk);
}

TEST(DirectLight, ConstantSkyGivesTheAlbedo) {
  SceneMaker maker;
  maker.scene().environment.radiance = Vec3(1.0F, 2.0F, 4.0F);
  const Vec3 mean = testing::mean_radiance(look_at_floor(maker, 64));
  EXPECT_NEAR(mean.x, kAlbedo, 0.01F);
  EXPECT_NEAR(mean.y, 2.0F * kAlbedo, 0.02F);
  EXPECT_NEAR(mean.z, 4.0F * kAlbedo, 0.04F);
}

// An image of one colour is a constant sky, in both mappings.
TEST(DirectLight, ImageSkyOfOneColourIsConstant) {
  for (const EnvironmentMapping mapping : {EnvironmentMapping::equirectangular, EnvironmentMapping::octahedral}) {
    auto image = std::make_shared<Image>();
    image->width = 16;
    image->height = mapping == EnvironmentMapping::octahedral ? 16 : 8;
    image->channels = 3;
    image->floats.assign(std::size_t{image->width} * image->height * 3, 0.5F);
    SceneMaker maker;
    maker.scene().images.push_back(image);
    maker.scene().environment.radiance = Vec3(2.0F);
    maker.scene().environment.image = 0;
    maker.scene().environment.mapping = mapping;
    EXPECT_NEAR(testing::mean_radiance(look_at_floor(maker, 256)).y, kAlbedo, 0.01F);
  }
}

// A lamp behind a surface that lets 30 % pass, half of the floor's sight of it also cut by a hole-free opaque one.
TEST(DirectLight, ShadowRaysPassTransparentSurfaces) {
  SceneMaker maker;
  Material veil = SceneMaker::diffuse(Vec3(0.0F));
  veil.alpha_mode = AlphaMode::blend;
  veil.alpha.value = 0.7F;
  maker.quad({-20, 1.5F, -20}, {0, 0, 40}, {40, 0, 0}, maker.material(veil));
  PunctualLight light;
  light.position = {0.0F, 2.0F, 0.0F};
  light.intensity = Vec3(3.0F);
  maker.scene().lights.push_back(light);
  const float expected = 0.3F * kAlbedo / kPi * 3.0F / 4.0F;
  EXPECT_NEAR(testing::mean_radiance(look_at_floor(maker, 16)).y, expected, 1e-3F * expected);
}

}  // namespace
}  // namespace grove
