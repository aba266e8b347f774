#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <array>
#include <atomic>
#include <cmath>
#include <stop_token>

#include "grove/base/error.h"
#include "grove/render/adaptive/noise.h"
#include "same_bits.h"
#include "test_scenes.h"

namespace grove {
namespace {

using testing::SceneMaker;

Film::Sample grey(float value) {
  return {.radiance = Vec3(value)};
}

TEST(Noise, FilmsKnowTheVarianceOfTheirSamples) {
  Film film(2, 1);
  for (const float value : {1.0F, 2.0F, 4.0F, 9.0F}) film.add(0, 0, grey(value));
  film.add(1, 0, grey(3.0F));
  // Mean 4, squared deviations 9 + 4 + 0 + 25.
  EXPECT_NEAR(film.sample_variance(0, 0), 38.0F / 3.0F, 1e-4F);
  EXPECT_NEAR(film.variance_of_mean(0, 0), 38.0F / 12.0F, 1e-4F);
  EXPECT_EQ(film.sample_variance(1, 0), 0.0F);
  Film parts(1, 1);
  for (const float value : {4.0F, 9.0F}) parts.add(0, 0, grey(value));
  film.add(1, 0, parts.pixel(0, 0));
  // 3, 4, 9
  EXPECT_NEAR(film.sample_variance(1, 0), 31.0F / 3.0F, 1e-4F);
}

TEST(Noise, IsTheRelativeStandardErrorPooledWithNeighbours) {
  Film film(17, 1);
  for (std::uint32_t x = 0; x < 17; ++x)
    for (int i = 0; i < 8; ++i) film.add(x, 0, grey(i % 2 == 0 ? 1.0F : 3.0F));
  const Tile tile = TileGrid(17, 1).tile(0);
  std::array<float, 16> noise{};
  estimate_noise(film, tile, 0.01F, noise);
  // Eight squared deviations of 1 over 7 degrees of freedom; mean 2.
  const float expected = std::sqrt(8.0F / 7.0F / 8.0F) / 2.0F;
  for (const float value : noise) EXPECT_NEAR(value, expected, 1e-5F);
  estimate_noise(film, tile, 4.0F, noise);
  EXPECT_NEAR(noise[0], 0.5F * expected, 1e-5F);

  // A calm pixel between restless ones is not trusted; far from them it is.
  Film mixed(16, 1);
  for (std::uint32_t x = 0; x < 16; ++x)
    for (int i = 0; i < 8; ++i) mixed.add(x, 0, grey(x < 4 && x != 1 && i % 2 == 0 ? 3.0F : 1.0F));
  estimate_noise(mixed, tile, 0.01F, noise);
  EXPECT_GT(noise[1], 0.1F);
  EXPECT_LT(noise[12], 1e-3F);
  mixed.restore(0, 0, {});
  estimate_noise(mixed, tile, 0.01F, noise);
  EXPECT_TRUE(std::isinf(noise[0]));
}

// A lamp over a floor, seen straight down so narrowly that all pixels have one value, which follows from the form factor.
TEST(AdaptiveSampling, ReachesItsTarget) {
  SceneMaker maker;
  constexpr float kHalf = 1.0F;
  maker.quad({-kHalf, 1.0F, -kHalf}, {2.0F * kHalf, 0, 0}, {0, 0, 2.0F * kHalf}, maker.material(SceneMaker::lamp(Vec3(5.0F))));
  maker.quad({-50, 0, -50}, {0, 0, 100}, {100, 0, 0}, maker.material(SceneMaker::diffuse(Vec3(0.5F))));
  maker.camera({0.0F, 0.9F, 0.0F}, {0.0F, 0.0F, 0.0F}, 0.002F, {0.0F, 0.0F, -1.0F});
  RenderSettings settings = testing::small_settings(24, 4096, 1);
  settings.noise.target = 0.03F;
  const RenderResult result = testing::render_scene(maker.make(), settings);
  EXPECT_FALSE(result.interrupted);
  EXPECT_EQ(result.completed_fraction, 1.0);
  const NoiseSummary noise = summarize_noise(result.film, result.part, settings.noise);
  EXPECT_EQ(noise.share_within, 1.0);
  EXPECT_LT(noise.most_samples, 4096U);
  EXPECT_GE(noise.least_samples, 16U);
  const float s = std::sqrt(2.0F);
  const float expected = 0.5F * 5.0F * (4.0F / (2.0F * kPi)) * (2.0F / s) * std::atan(1.0F / s);
  double squares = 0.0;
  for (std::uint32_t y = 0; y < 24; ++y) {
    for (std::uint32_t x = 0; x < 24; ++x) {
      const double error = static_cast<double>(result.film.mean(x, y).radiance.y / expected - 1.0F);
      squares += error * error / (24.0 * 24.0);
    }
  }
  EXPECT_LT(std::sqrt(squares), 0.03);
  EXPECT_GT(std::sqrt(squares), 0.0005) << "far more samples than needed";
}

class AdaptivePicture : public ::testing::Test {
 protected:
  AdaptivePicture() : scene_(testing::mixed_scene()), accelerator_(scene_, "bvh"), settings_(testing::small_settings(0, 64, 3)) {
    settings_.width = 50;
    settings_.height = 37;  // tiles that stick out
    settings_.noise = {.target = 0.3F, .min_samples = 8};
  }
  [[nodiscard]] RenderResult render_whole() const { return render(scene_, accelerator_, settings_); }

  Scene scene_;
  SceneAccelerator accelerator_;
  RenderSettings settings_;
};

TEST_F(AdaptivePicture, SpendsSamplesWhereTheNoiseIs) {
  const RenderResult whole = render_whole();
  const NoiseSummary noise = summarize_noise(whole.film, whole.part, settings_.noise);
  EXPECT_EQ(noise.least_samples, 8U);
  EXPECT_EQ(noise.most_samples, 64U);
  EXPECT_GT(noise.share_within, 0.3);
  // Whoever stopped early had reason to.
  std::array<float, 256> values{};
  const TileGrid grid(50, 37);
  for (std::size_t i = 0; i < grid.count(); ++i) {
    const Tile tile = grid.tile(i);
    estimate_noise(whole.film, tile, settings_.noise.floor, values);
    std::size_t place = 0;
    for (std::uint32_t y = tile.first_y; y < tile.end_y; ++y) {
      for (std::uint32_t x = tile.first_x; x < tile.end_x; ++x, ++place) {
        if (whole.film.pixel(x, y).taken() < 64) {
          EXPECT_LE(values.at(place), 0.3F);
        }
      }
    }
  }
}

TEST_F(AdaptivePicture, DoesNotDependOnThreads) {
  const oneapi::tbb::global_control allowed(oneapi::tbb::global_control::max_allowed_parallelism, 4);
  RenderResult whole;
  RenderResult other;
  oneapi::tbb::task_arena(1).execute([&] { whole = render_whole(); });
  oneapi::tbb::task_arena(4).execute([&] { other = render_whole(); });
  EXPECT_TRUE(testing::same_bits(whole.film, other.film));
}

TEST_F(AdaptivePicture, IsThatOfItsTiles) {
  const RenderResult whole = render_whole();
  Film sum(50, 37);
  for (std::uint32_t share = 0; share < 3; ++share) {
    settings_.part = {.share = share, .share_count = 3};
    const RenderResult part = render(scene_, accelerator_, settings_);
    EXPECT_FALSE(part.interrupted);
    for (std::uint32_t y = 0; y < 37; ++y)
      for (std::uint32_t x = 0; x < 50; ++x) sum.add(x, y, part.film.pixel(x, y));
  }
  EXPECT_TRUE(testing::same_bits(whole.film, sum));
}

TEST_F(AdaptivePicture, GoesOnAsIfItHadNotBeenInterrupted) {
  const RenderResult whole = render_whole();
  RenderCheckpoints checkpoints;
  int interruptions = 0;
  for (;;) {
    std::stop_source stop;
    ProgressReporter progress;
    progress.stop = stop.get_token();
    // Each time a little farther.
    progress.report = [&](std::uint64_t done, std::uint64_t /*total*/) {
      if (done > 4000) stop.request_stop();
    };
    RenderResult result = render(scene_, accelerator_, settings_, progress, std::move(checkpoints));
    if (!result.interrupted) {
      EXPECT_TRUE(testing::same_bits(whole.film, result.film));
      break;
    }
    ++interruptions;
    checkpoints.earlier = std::move(result);
    ASSERT_LT(interruptions, 100);
  }
  EXPECT_GT(interruptions, 2);
}

TEST_F(AdaptivePicture, RefusesToLeaveSamplesOut) {
  settings_.part.end_sample = 32;
  EXPECT_THROW((void)render(scene_, accelerator_, settings_), UsageError);
}

// A clock that each sample moves on by a second, as far as samples are reported, and more slowly at first than later.
struct SampleClock {
  std::atomic<std::uint64_t> seconds{0};
  std::uint64_t slow_from = UINT64_MAX;

  [[nodiscard]] ProgressReporter reporter() {
    ProgressReporter progress;
    progress.report = [this](std::uint64_t done, std::uint64_t /*total*/) { seconds = done + (done > slow_from ? 1000000 : 0); };
    return progress;
  }
};

class TimeLimits : public AdaptivePicture {
 protected:
  RenderResult render_within(double seconds, SampleClock& clock) {
    settings_.noise = {};
    settings_.samples_per_pixel = 1000;
    settings_.time_limit = seconds;
    settings_.clock = [&clock] { return static_cast<double>(clock.seconds); };
    return render(scene_, accelerator_, settings_, clock.reporter());
  }
  static constexpr double kPixels = 50 * 37;
};

TEST_F(TimeLimits, TakesWhatFitsAndIsEven) {
  SampleClock clock;
  const RenderResult result = render_within(30 * kPixels, clock);
  EXPECT_TRUE(result.out_of_time);
  EXPECT_FALSE(result.interrupted);
  const NoiseSummary noise = summarize_noise(result.film, result.part, {});
  EXPECT_EQ(noise.least_samples, noise.most_samples);
  // Not the 32 at which the next round would have ended, and a little less than 30 for caution.
  EXPECT_GE(noise.least_samples, 28U);
  EXPECT_LE(noise.least_samples, 30U);
}

TEST_F(TimeLimits, TakesACutRoundBack) {
  SampleClock clock;
  clock.slow_from = static_cast<std::uint64_t>(11 * kPixels);
  const RenderResult result = render_within(30 * kPixels, clock);
  EXPECT_TRUE(result.out_of_time);
  const NoiseSummary noise = summarize_noise(result.film, result.part, {});
  EXPECT_EQ(noise.least_samples, 8U);
  EXPECT_EQ(noise.most_samples, 8U);
}

TEST_F(TimeLimits, TheFirstRoundIsAlwaysFinished) {
  SampleClock clock;
  const RenderResult result = render_within(1.0, clock);
  EXPECT_TRUE(result.out_of_time);
  const NoiseSummary noise = summarize_noise(result.film, result.part, {});
  EXPECT_EQ(noise.least_samples, 1U);
  EXPECT_EQ(noise.most_samples, 1U);
}

TEST_F(TimeLimits, EnoughTimeChangesNothing) {
  SampleClock clock;
  settings_.noise = {};
  settings_.samples_per_pixel = 8;
  const RenderResult free = render(scene_, accelerator_, settings_);
  settings_.time_limit = 1e9;
  settings_.clock = [&clock] { return static_cast<double>(clock.seconds); };
  const RenderResult limited = render(scene_, accelerator_, settings_, clock.reporter());
  EXPECT_FALSE(limited.out_of_time);
  EXPECT_TRUE(testing::same_bits(free.film, limited.film));
}

}  // namespace
}  // namespace grove
