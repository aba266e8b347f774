// What the denoiser must leave alone, and what it must make better.

#include <gtest/gtest.h>

#include <algorithm>
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

double mean_of(const Illumination& light) {
  double sum = 0.0;
  for (const float value : light.green) sum += static_cast<double>(value);
  return sum / static_cast<double>(light.green.size());
}

// Noise whose light comes in rare bright samples, as the mean of so many a pixel; with what each pixel's samples tell of it.
struct RareLight {
  Illumination light;
  std::vector<MeasuredNoise> noise;
};

RareLight rare_light(std::size_t count, std::uint32_t samples) {
  constexpr float kBright = 60.0F;
  RareLight result{Illumination(count), std::vector<MeasuredNoise>(count)};
  std::uint32_t state = 7;
  for (std::size_t i = 0; i < count; ++i) {
    float sum = 0.0F;
    float squares = 0.0F;
    for (std::uint32_t s = 0; s < samples; ++s) {
      state = state * 1664525U + 1013904223U;
      const float value = (state >> 8) % 200 == 0 ? kBright : 1.0F;
      sum += value;
      squares += value * value;
    }
    const auto n = static_cast<float>(samples);
    result.light.set_colour(i, Vec3(sum / n));
    result.noise[i] = {samples > 1 ? (squares - sum * sum / n) / (n - 1.0F) / n : 0.0F, samples > 1, true};
  }
  return result;
}

TEST(Denoise, KeepsTheBrightnessOfRareLight) {
  constexpr std::uint32_t kSide = 96;
  const Guides guides = flat_guides(kSide);
  for (const std::uint32_t samples : {1U, 4U, 16U}) {
    const RareLight rare = rare_light(std::size_t{kSide} * kSide, samples);
    const Illumination filtered = filter_light(rare.light, rare.noise, guides, {}, {rare.light, Illumination()});
    const double mean = mean_of(rare.light);
    EXPECT_NEAR(mean_of(filtered), mean, 0.05 * mean) << samples;
    // Spread over the surface it was taken from, not left standing.
    EXPECT_LT(*std::ranges::max_element(filtered.green), (samples == 1 ? 0.3F : 0.7F) * *std::ranges::max_element(rare.light.green))
        << samples;
  }
}

TEST(KeepBrightness, FollowsTheNewestWhereLightsHaveChanged) {
  constexpr std::uint32_t kSide = 40;
  const Guides guides = flat_guides(kSide);
  constexpr std::size_t kCount = std::size_t{kSide} * kSide;
  BrightnessEvidence evidence{Illumination(kCount), Illumination(kCount)};
  Illumination filtered(kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    evidence.samples.set_colour(i, Vec3(5.0F));
    evidence.samples.variance[i] = 0.01F;
    evidence.newest.set_colour(i, Vec3(1.0F));
    evidence.newest.variance[i] = 0.25F;
    filtered.set_colour(i, Vec3(1.5F));
  }
  Illumination changed = filtered;
  keep_brightness(evidence, guides, changed);
  EXPECT_NEAR(mean_of(changed), 1.0, 0.02);
  // Noise that explains the difference leaves all samples their say.
  std::ranges::fill(evidence.newest.variance, 1e6F);
  keep_brightness(evidence, guides, filtered);
  EXPECT_NEAR(mean_of(filtered), 5.0, 0.05);
}

TEST(KeepBrightness, LeavesAloneWhatIsUnsureOrNoSurface) {
  constexpr std::uint32_t kSide = 20;
  Guides guides = flat_guides(kSide);
  constexpr std::size_t kCount = std::size_t{kSide} * kSide;
  BrightnessEvidence evidence{Illumination(kCount), Illumination()};
  Illumination filtered(kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    const bool is_left = i % kSide < 8;
    evidence.samples.set_colour(i, Vec3(is_left ? 3.0F : 1.0F));
    evidence.samples.variance[i] = is_left ? 1e9F : 0.0F;
    filtered.set_colour(i, Vec3(1.0F));
  }
  guides.normal_z[19] = 0.0F;
  keep_brightness(evidence, guides, filtered);
  EXPECT_EQ(filtered.green[19], 1.0F) << "the sky";
  EXPECT_NEAR(filtered.green[17], 1.0F, 1e-4F) << "sure of itself";
  EXPECT_NEAR(mean_of(filtered), (8.0 * 3.0 + 12.0) / 20.0, 0.05) << "what the whole lacks goes where it is not sure";
}

TEST(Denoise, TakesErrorAway) {
  const Scene scene = mixed_scene();
  const ColourImage reference = mean_colours(noisy_render(scene, 32, 256).film);
  const RenderResult noisy = noisy_render(scene, 32, 4);
  EXPECT_LT(squared_error(reference, denoise(noisy)), 0.75 * squared_error(reference, mean_colours(noisy.film)));
}

TEST(Denoise, TendsToTheFilmAsSamplesGrow) {
  const Scene scene = mixed_scene();
  // Relative, so that a pixel that happens to meet one of the rare bright samples, and is taken down, does not rule all others.
  double previous = 1e9;
  for (const std::uint32_t samples : {2U, 32U, 512U}) {
    const RenderResult result = noisy_render(scene, 24, samples);
    const double change = std::sqrt(squared_error(mean_colours(result.film), denoise(result)));
    EXPECT_LT(change, 0.6 * previous) << samples;
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
