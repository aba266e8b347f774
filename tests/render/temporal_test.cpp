// Frames one after the other.

#include <gtest/gtest.h>

#include <cmath>

#include "grove/render/compare/picture_difference.h"
#include "grove/render/denoise/temporal.h"
#include "render/test_scenes.h"

namespace grove::testing {
namespace {

// Renders a frame of its own seed, measures its motion against the one before, and denoises it.
class Sequence {
 public:
  Sequence(std::uint32_t side, std::uint32_t samples) : settings_(small_settings(side, samples, 3)) {
    settings_.gathering.first_hits = true;
  }

  ColourImage next(const Scene& scene) {
    const CameraRays camera(scene.cameras[0], settings_.width, settings_.height);
    movement_ = earlier_ ? movement_since(*earlier_, scene, camera) : Movement::some;
    settings_.gathering.earlier = earlier_ ? &*earlier_ : nullptr;
    ++settings_.seed;
    frame_ = render_scene(scene, settings_);
    earlier_.emplace(EarlierFrame{ScenePose(scene), camera});
    return denoiser_.add(frame_, movement_);
  }

  [[nodiscard]] const RenderResult& frame() const { return frame_; }
  [[nodiscard]] Movement movement() const { return movement_; }
  [[nodiscard]] const PixelHistory& history(std::uint32_t x, std::uint32_t y) const {
    return denoiser_.history().pixels[std::size_t{y} * settings_.width + x];
  }

 private:
  RenderSettings settings_;
  TemporalDenoiser denoiser_;
  std::optional<EarlierFrame> earlier_;
  RenderResult frame_;
  Movement movement_ = Movement::some;
};

double relative_error(const ColourImage& reference, const ColourImage& image) {
  return compare_pictures(reference, image, 1.0F, ToneMap::aces).relative_mse;
}

// A floor with a block before it, under a point light and a sky.
Scene yard(float camera_x, float block_x = 0.0F, float light = 20.0F) {
  SceneMaker maker;
  const std::uint32_t white = maker.material(SceneMaker::diffuse(Vec3(0.6F)));
  const std::uint32_t red = maker.material(SceneMaker::diffuse({0.8F, 0.2F, 0.2F}));
  maker.quad({-20, 0, 20}, {40, 0, 0}, {0, 0, -40}, white);
  maker.quad({block_x - 0.5F, 0.5F, 1}, {1, 0, 0}, {0, 1, 0}, red);
  PunctualLight lamp;
  lamp.position = {3, 6, 3};
  lamp.intensity = Vec3(light);
  maker.scene().lights.push_back(lamp);
  maker.scene().environment.radiance = Vec3(0.3F);
  maker.camera({camera_x, 3, 8}, {camera_x, 0.5F, 0}, 0.8F);
  return maker.make();
}

TEST(Temporal, TendsToTheUnfilteredPictureWhenNothingMoves) {
  constexpr std::uint32_t kSide = 20;
  const Scene scene = yard(0.0F);
  Sequence sequence(kSide, 2);
  ColourImage sum(kSide, kSide);
  double early = 0.0;
  for (std::uint32_t frame = 1; frame <= 128; ++frame) {
    const ColourImage image = sequence.next(scene);
    EXPECT_EQ(sequence.movement(), frame == 1 ? Movement::some : Movement::none);
    ColourImage mean(kSide, kSide);
    for (std::size_t i = 0; i < sum.pixels.size(); ++i) {
      sum.pixels[i] += sequence.frame().film.mean(static_cast<std::uint32_t>(i % kSide), static_cast<std::uint32_t>(i / kSide)).radiance;
      mean.pixels[i] = sum.pixels[i] / static_cast<float>(frame);
    }
    if (frame == 4) early = compare_pictures(mean, image, 1.0F, ToneMap::aces).rmse;
    if (frame < 128) continue;
    EXPECT_LT(compare_pictures(mean, image, 1.0F, ToneMap::aces).rmse, 0.4 * early);
    // What the filter works on is the mean itself.
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
      const PixelHistory& pixel = sequence.history(i % kSide, i / kSide);
      EXPECT_EQ(pixel.sample_count, 256.0F);
      EXPECT_LT(glm::length(pixel.reflected + pixel.emitted - mean.pixels[i]), 1e-3F * (1.0F + glm::length(mean.pixels[i]))) << i;
    }
  }
}

// Not each frame for itself is rid of what is rare and bright, else it would never come in.
TEST(Temporal, LosesNothingOfWhatIsRareWhenNothingMoves) {
  constexpr std::uint32_t kSide = 16;
  const Scene scene = mixed_scene();
  Sequence sequence(kSide, 4);
  ColourImage sum(kSide, kSide);
  for (int frame = 0; frame < 4; ++frame) {
    (void)sequence.next(scene);
    for (std::size_t i = 0; i < sum.pixels.size(); ++i) {
      sum.pixels[i] += sequence.frame().film.mean(static_cast<std::uint32_t>(i % kSide), static_cast<std::uint32_t>(i / kSide)).radiance;
    }
  }
  for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
    const PixelHistory& pixel = sequence.history(i % kSide, i / kSide);
    const Vec3 mean = sum.pixels[i] / 4.0F;
    EXPECT_LT(glm::length(pixel.reflected + pixel.emitted - mean), 1e-3F * (1.0F + glm::length(mean))) << i;
  }
}

TEST(Temporal, CarriesSamplesAlongWithTheCamera) {
  constexpr std::uint32_t kSide = 40;
  Sequence sequence(kSide, 1);
  double with = 0.0;
  double without = 0.0;
  for (int frame = 0; frame < 6; ++frame) {
    const Scene scene = yard(0.07F * static_cast<float>(frame));
    const ColourImage image = sequence.next(scene);
    if (frame < 5) continue;
    RenderSettings many = small_settings(kSide, 64, 3);
    const ColourImage reference = mean_colours(render_scene(scene, many).film);
    with = relative_error(reference, image);
    without = relative_error(reference, denoise(sequence.frame()));
  }
  EXPECT_EQ(sequence.movement(), Movement::some);
  EXPECT_GT(sequence.history(20, 36).sample_count, 4.5F) << "the floor was in view all the time";
  EXPECT_LT(with, without);
}

TEST(Temporal, StartsAnewWhatWasHidden) {
  constexpr std::uint32_t kSide = 40;
  Sequence sequence(kSide, 1);
  for (int frame = 0; frame < 4; ++frame) (void)sequence.next(yard(0.0F));
  const FirstHit before = sequence.frame().first_hits->at(20, 18);
  (void)sequence.next(yard(0.0F, 1.2F));
  EXPECT_EQ(sequence.movement(), Movement::some);
  EXPECT_NE(sequence.frame().first_hits->at(20, 18).geometry, before.geometry) << "the block has left this pixel";
  EXPECT_EQ(sequence.history(20, 18).sample_count, 1.0F);
  EXPECT_EQ(sequence.history(3, 36).sample_count, 5.0F) << "the floor far away";
}

TEST(Temporal, LightThatGoesOutDoesNotLinger) {
  constexpr std::uint32_t kSide = 24;
  Sequence sequence(kSide, 1);
  float before = 0.0F;
  for (int frame = 0; frame < 6; ++frame) before = sequence.next(yard(0.0F, 0.0F, 400.0F)).at(3, 20).y;
  ColourImage image;
  for (int frame = 0; frame < 2; ++frame) image = sequence.next(yard(0.0F, 0.0F, 1.0F + 0.001F * static_cast<float>(frame)));
  const float now = sequence.frame().film.mean(3, 20).radiance.y;
  EXPECT_GT(before, 1.5F * now);
  EXPECT_NEAR(image.at(3, 20).y, now, 0.15F * (before - now));
}

TEST(Temporal, IsTheSameForAnyNumberOfRuns) {
  Sequence one(16, 1);
  Sequence other(16, 1);
  for (int frame = 0; frame < 3; ++frame) {
    const Scene scene = yard(0.1F * static_cast<float>(frame));
    EXPECT_EQ(one.next(scene).pixels, other.next(scene).pixels);
  }
}

}  // namespace
}  // namespace grove::testing
