// What the denoiser must leave alone, and what it must make better.

#include <gtest/gtest.h>

#include <cmath>

#include "grove/render/compare/picture_difference.h"
#include "grove/render/denoise/denoise.h"
#include "render/test_scenes.h"

namespace grove::testing {
namespace {

RenderResult noisy_render(const Scene& scene, std::uint32_t side, std::uint32_t samples) {
  RenderSettings settings = small_settings(side, samples, 3);
  settings.gathering.first_hits = true;
  return render_scene(scene, settings);
}

double squared_error(const ColourImage& reference, const ColourImage& image) {
  return compare_pictures(reference, image, 1.0F, ToneMap::aces).relative_mse;
}

// A surface that faces the viewer everywhere.
Guides flat_guides(std::uint32_t side) {
  Guides guides;
  guides.width = side;
  guides.height = side;
  const std::size_t count = std::size_t{side} * side;
  for (auto* plane : {&guides.normal_x, &guides.normal_y, &guides.slope_x, &guides.slope_y}) plane->assign(count, 0.0F);
  guides.normal_z.assign(count, 1.0F);
  guides.depth.assign(count, 5.0F);
  guides.albedo.assign(count, Vec3(0.5F));
  return guides;
}

TEST(ATrous, LeavesAloneWhatIsSure) {
  constexpr std::uint32_t kSide = 33;
  const Guides guides = flat_guides(kSide);
  Illumination light(kSide * kSide);
  for (std::size_t i = 0; i < light.red.size(); ++i) light.set_colour(i, Vec3(1.0F + 0.01F * static_cast<float>(i % 7), 1.0F, 1.0F));
  const Illumination filtered = filter_a_trous(light, guides);
  for (std::size_t i = 0; i < light.red.size(); ++i) EXPECT_NEAR(filtered.red[i], light.red[i], 1e-5F);
}

TEST(ATrous, SmoothsNoiseToItsMeanAndKnowsIt) {
  constexpr std::uint32_t kSide = 65;
  const Guides guides = flat_guides(kSide);
  Illumination light(kSide * kSide);
  std::uint32_t state = 1;
  double sum = 0.0;
  for (std::size_t i = 0; i < light.red.size(); ++i) {
    state = state * 1664525U + 1013904223U;
    const float value = 1.0F + static_cast<float>(state >> 8) / 16777216.0F;
    light.set_colour(i, Vec3(value));
    light.variance[i] = 1.0F / 12.0F;
    sum += value;
  }
  const Illumination filtered = filter_a_trous(light, guides);
  const std::size_t middle = kSide * (kSide / 2) + kSide / 2;
  EXPECT_NEAR(filtered.green[middle], sum / static_cast<double>(light.red.size()), 0.03);
  EXPECT_LT(filtered.variance[middle], light.variance[middle] / 100.0F);
}

TEST(ATrous, KeepsEdgesOfEachGuide) {
  constexpr std::uint32_t kSide = 32;
  const auto contrast_with = [&](const auto& cut) {
    Guides guides = flat_guides(kSide);
    Illumination light(kSide * kSide);
    for (std::size_t i = 0; i < light.red.size(); ++i) {
      const bool is_right = i % kSide >= kSide / 2;
      light.set_colour(i, Vec3(is_right ? 1.0F : 0.0F));
      light.variance[i] = 1.0F;
      if (is_right) cut(guides, i);
    }
    const Illumination filtered = filter_a_trous(light, guides);
    const std::size_t row = std::size_t{kSide} * (kSide / 2);
    return filtered.red[row + kSide / 2] - filtered.red[row + kSide / 2 - 1];
  };
  EXPECT_LT(contrast_with([](Guides& /*guides*/, std::size_t /*i*/) {}), 0.5F)
      << "nothing tells the sides apart but light that may be noise";
  EXPECT_NEAR(contrast_with([](Guides& guides, std::size_t i) { guides.depth[i] = 6.0F; }), 1.0F, 1e-4F);
  EXPECT_NEAR(contrast_with([](Guides& guides, std::size_t i) {
                guides.normal_x[i] = 0.5F;
                guides.normal_z[i] = std::sqrt(0.75F);
              }),
              1.0F, 1e-3F);
}

TEST(Denoise, TakesErrorAway) {
  const Scene scene = mixed_scene();
  const ColourImage reference = mean_colours(noisy_render(scene, 32, 256).film);
  const RenderResult noisy = noisy_render(scene, 32, 4);
  EXPECT_LT(squared_error(reference, denoise(noisy)), 0.75 * squared_error(reference, mean_colours(noisy.film)));
}

TEST(Denoise, TendsToTheFilmAsSamplesGrow) {
  const Scene scene = mixed_scene();
  double previous = 1e9;
  for (const std::uint32_t samples : {4U, 32U, 256U}) {
    const RenderResult result = noisy_render(scene, 24, samples);
    const double change = compare_pictures(mean_colours(result.film), denoise(result), 1.0F, ToneMap::aces).rmse;
    EXPECT_LT(change, 0.75 * previous) << samples;  // about half, give or take the luck of one picture
    previous = change;
  }
}

TEST(Denoise, IsTheSameForAnyThreadsAndStructure) {
  const Scene scene = mixed_scene();
  RenderSettings settings = small_settings(20, 2, 3);
  settings.gathering.first_hits = true;
  EXPECT_EQ(denoise(render_scene(scene, settings, "bvh")).pixels, denoise(render_scene(scene, settings, "octree")).pixels);
}

TEST(Denoise, LeavesSkyAndLampsAsTheyAre) {
  SceneMaker maker;
  const std::uint32_t lamp = maker.material(SceneMaker::lamp(Vec3(9.0F)));
  maker.quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, lamp);
  maker.scene().environment.radiance = Vec3(0.2F, 0.3F, 0.4F);
  maker.camera({0, 0, 6}, {0, 0, 0}, 0.7F);
  const RenderResult result = noisy_render(maker.make(), 24, 4);
  const ColourImage image = denoise(result);
  const ColourImage means = mean_colours(result.film);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) EXPECT_LT(glm::length(image.pixels[i] - means.pixels[i]), 1e-4F) << i;
}

}  // namespace
}  // namespace grove::testing
