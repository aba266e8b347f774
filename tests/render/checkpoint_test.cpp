// Renders that are interrupted and gone on with make the bits of those that are not; parts hold what they were asked for.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "grove/base/error.h"
#include "same_bits.h"
#include "test_scenes.h"

namespace grove {
namespace {

using testing::same_bits;

RenderSettings settings_of(std::uint32_t samples) {
  RenderSettings settings = testing::small_settings(0, samples);
  settings.width = 50;
  settings.height = 37;  // tiles that stick out
  settings.seed = 5;
  return settings;
}

class Checkpoints : public ::testing::Test {
 protected:
  [[nodiscard]] RenderResult render_all(const RenderSettings& settings) const { return render(scene_, accelerator_, settings); }

  [[nodiscard]] RenderResult go_on(const RenderSettings& settings, const RenderResult& earlier) const {
    RenderCheckpoints checkpoints;
    checkpoints.earlier = earlier;
    return render(scene_, accelerator_, settings, {}, checkpoints);
  }

  Scene scene_ = testing::mixed_scene();
  SceneAccelerator accelerator_{scene_, "bvh"};
};

TEST_F(Checkpoints, GoingOnFromAnyGivesTheSameBits) {
  const RenderSettings settings = settings_of(21);
  const RenderResult whole = render_all(settings);
  std::vector<RenderResult> saved;
  int saves = 0;
  RenderCheckpoints checkpoints;
  checkpoints.interval_seconds = 0.0;  // as often as can be
  checkpoints.save = [&](const RenderResult& result) {
    EXPECT_TRUE(result.interrupted);
    if (saves++ % 400 == 7) saved.push_back(result);
  };
  const RenderResult saving = render(scene_, accelerator_, settings, {}, checkpoints);
  EXPECT_TRUE(same_bits(whole.film, saving.film));
  EXPECT_EQ(whole.rays_traced, saving.rays_traced);
  ASSERT_GE(saved.size(), 3U) << "of " << saves;
  double last_fraction = 0.0;
  for (const RenderResult& earlier : saved) {
    EXPECT_GT(earlier.completed_fraction, last_fraction);
    last_fraction = earlier.completed_fraction;
    const RenderResult result = go_on(settings, earlier);
    EXPECT_TRUE(same_bits(whole.film, result.film));
    EXPECT_EQ(whole.rays_traced, result.rays_traced);
    EXPECT_FALSE(result.interrupted);
    EXPECT_EQ(result.completed_fraction, 1.0);
  }
}

TEST_F(Checkpoints, ManyInterruptionsGiveTheSameBits) {
  const RenderSettings settings = settings_of(9);
  RenderResult result;
  result.film = Film(settings.width, settings.height);
  int runs = 0;
  do {
    std::stop_source source;
    ProgressReporter progress;
    progress.stop = source.get_token();
    progress.report = [&](std::uint64_t done, std::uint64_t /*total*/) {
      if (done > 1500) source.request_stop();
    };
    RenderCheckpoints checkpoints;
    checkpoints.earlier = std::move(result);
    result = render(scene_, accelerator_, settings, progress, std::move(checkpoints));
    ++runs;
  } while (result.interrupted && runs < 100);
  EXPECT_GT(runs, 3);
  EXPECT_TRUE(same_bits(render_all(settings).film, result.film));
}

TEST_F(Checkpoints, MoreSamplesAreAddedToAFinishedPicture) {
  const RenderResult few = render_all(settings_of(5));
  EXPECT_TRUE(same_bits(render_all(settings_of(19)).film, go_on(settings_of(19), few).film));
}

TEST_F(Checkpoints, FinishedWorkIsNotDoneAgain) {
  const RenderResult whole = render_all(settings_of(3));
  const RenderResult again = go_on(settings_of(3), whole);
  EXPECT_TRUE(same_bits(whole.film, again.film));
  EXPECT_EQ(whole.rays_traced, again.rays_traced);
}

TEST_F(Checkpoints, FilmsThatDoNotFitAreRefused) {
  const RenderResult whole = render_all(settings_of(3));
  EXPECT_THROW((void)go_on(settings_of(2), whole), UsageError) << "it has more samples than are asked for";
  RenderSettings other = settings_of(3);
  other.height = 38;
  EXPECT_THROW((void)go_on(other, whole), UsageError);
}

TEST_F(Checkpoints, SharesHoldTheirTilesAlone) {
  RenderSettings settings = settings_of(4);
  const RenderResult whole = render_all(settings);
  for (const std::uint32_t shares : {1U, 2U, 3U, 12U}) {  // there are 4 x 3 tiles
    Film sum(settings.width, settings.height);
    for (std::uint32_t share = 0; share < shares; ++share) {
      settings.part = {.share = share, .share_count = shares};
      const RenderResult part = render_all(settings);
      EXPECT_EQ(part.completed_fraction, 1.0);
      for (std::uint32_t y = 0; y < settings.height; ++y) {
        for (std::uint32_t x = 0; x < settings.width; ++x) {
          const bool is_mine = (y / 16 * 4 + x / 16) % shares == share;
          EXPECT_EQ(part.film.pixel(x, y).taken(), is_mine ? 4U : 0U);
          if (is_mine) sum.add(x, y, part.film.pixel(x, y));
        }
      }
    }
    EXPECT_TRUE(same_bits(whole.film, sum)) << shares;
  }
}

TEST_F(Checkpoints, PartsThatCannotBeAreRefused) {
  const auto message_of = [&](const PicturePart& part) -> std::string {
    RenderSettings settings = settings_of(8);
    settings.part = part;
    try {
      (void)render_all(settings);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(message_of({12, 13, 0, 8}), ::testing::HasSubstr("has no tiles"));
  EXPECT_THAT(message_of({3, 3, 0, 8}), ::testing::HasSubstr("has no tiles"));
  EXPECT_THAT(message_of({0, 1, 5, 5}), ::testing::HasSubstr("samples 5:5"));
  EXPECT_THAT(message_of({0, 1, 0, 9}), ::testing::HasSubstr("samples 0:9"));
}

TEST(PicturePart, CountsItsTilesAndPixels) {
  const TileGrid grid(50, 37);
  ASSERT_EQ(grid.count(), 12U);
  for (std::uint32_t shares = 1; shares <= 14; ++shares) {
    std::size_t tiles = 0;
    std::uint64_t pixels = 0;
    for (std::uint32_t share = 0; share < shares; ++share) {
      const PicturePart part{share, shares, 0, 1};
      tiles += part.tile_count(grid);
      pixels += part.pixel_count(grid);
      for (std::size_t i = 0; i < part.tile_count(grid); ++i) {
        EXPECT_LT(part.tile_number(i), grid.count());
        EXPECT_TRUE(part.has_tile(part.tile_number(i)));
      }
    }
    EXPECT_EQ(tiles, 12U) << shares;
    EXPECT_EQ(pixels, 50U * 37U) << shares;
  }
  EXPECT_EQ((PicturePart{1, 4, 8, 16}.text()), "--tile 2/4 --samples 8:16");
  EXPECT_EQ((PicturePart{0, 1, 0, 16}.text()), "--samples 0:16");
}

}  // namespace
}  // namespace grove
