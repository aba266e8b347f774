#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "grove/base/error.h"
#include "grove/render/saved/merge_films.h"
#include "lab/temporary_directory.h"
#include "same_bits.h"
#include "test_scenes.h"

namespace grove {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::same_bits;

class Merge : public ::testing::Test {
 protected:
  Merge() {
    settings_.width = 50;
    settings_.height = 37;
    settings_.samples_per_pixel = 10;
  }

  [[nodiscard]] RenderResult whole() {
    settings_.part = {};
    return render(scene_, accelerator_, settings_);
  }

  /// Renders a part into a file of this name.
  std::filesystem::path make(const std::string& name, const PicturePart& part, const ProgressReporter& progress = {}) {
    settings_.part = part;
    const RenderResult result = render(scene_, accelerator_, settings_, progress);
    FilmHeader header;
    header.picture = picture_identity(scene_, accelerator_, settings_);
    header.width = settings_.width;
    header.height = settings_.height;
    header.samples_per_pixel = settings_.samples_per_pixel;
    header.part = result.part;
    header.rays_traced = result.rays_traced;
    write_film(header, result.film, directory_ / name);
    return directory_ / name;
  }

  static std::string error_of(const std::vector<std::filesystem::path>& files) {
    try {
      (void)merge_films(files);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }

  RenderSettings settings_;
  Scene scene_ = testing::mixed_scene();
  SceneAccelerator accelerator_{scene_, "bvh"};
  testing::TemporaryDirectory directory_;
};

TEST_F(Merge, TilesAreTheSingleRenderBitForBit) {
  std::vector<std::filesystem::path> files;
  for (std::uint32_t share = 0; share < 5; ++share) files.push_back(make(std::to_string(share), {share, 5, 0, 10}));
  std::ranges::reverse(files);
  const MergedFilm merged = merge_films(files);
  const RenderResult single = whole();
  EXPECT_TRUE(same_bits(merged.whole.film, single.film));
  EXPECT_EQ(merged.whole.header.rays_traced, single.rays_traced);
  EXPECT_TRUE(merged.whole.header.part.is_whole(10));
  EXPECT_EQ(merged.missing, "");
}

TEST_F(Merge, SampleRangesGiveTheSameBitsInAnyOrder) {
  std::vector<std::filesystem::path> files{make("a", {0, 1, 0, 3}), make("b", {0, 1, 3, 4}), make("c", {0, 1, 4, 10})};
  const Film first = merge_films(files).whole.film;
  // The order is that of the sample numbers.
  Film by_hand(50, 37);
  for (const std::filesystem::path& file : files) {
    const SavedFilm part = read_film(file);
    for (std::uint32_t y = 0; y < 37; ++y)
      for (std::uint32_t x = 0; x < 50; ++x) by_hand.add(x, y, part.film.pixel(x, y));
  }
  EXPECT_TRUE(same_bits(first, by_hand));
  while (std::ranges::next_permutation(files).found) {
    const MergedFilm merged = merge_films(files);
    EXPECT_TRUE(same_bits(first, merged.whole.film));
    EXPECT_EQ(merged.missing, "");
  }
  // The same samples as the single render has, but for rounding.
  const Film single = whole().film;
  for (std::uint32_t y = 0; y < 37; ++y) {
    for (std::uint32_t x = 0; x < 50; ++x) {
      EXPECT_EQ(first.pixel(x, y).sample_count, single.pixel(x, y).sample_count);
      EXPECT_NEAR(first.mean(x, y).radiance.x, single.mean(x, y).radiance.x, 1e-5F * (1.0F + single.mean(x, y).radiance.x));
    }
  }
}

TEST_F(Merge, TilesAndRangesMayBeMixed) {
  const MergedFilm merged =
      merge_films(std::vector{make("a", {0, 2, 0, 10}), make("b", {1, 4, 0, 10}), make("c", {3, 4, 0, 6}), make("d", {3, 4, 6, 10})});
  EXPECT_EQ(merged.missing, "");
  for (std::uint32_t y = 0; y < 37; ++y)
    for (std::uint32_t x = 0; x < 50; ++x) EXPECT_EQ(merged.whole.film.pixel(x, y).taken(), 10U);
}

TEST_F(Merge, FilmsThatHoldTheSameSamplesAreNamed) {
  const auto half = make("half", {0, 2, 0, 10});
  const auto third = make("third", {1, 3, 9, 10});
  EXPECT_THAT(error_of({half, third}),
              AllOf(HasSubstr("half (--tile 1/2 --samples 0:10)"), HasSubstr("third (--tile 2/3 --samples 9:10)")));
  EXPECT_THAT(error_of({half, half}), HasSubstr("leave one of them out"));
  EXPECT_EQ(error_of({half, make("other", {1, 2, 0, 10})}), "no error");
}

TEST_F(Merge, WhatIsMissingIsNamedAsItIsRendered) {
  const auto a = make("a", {0, 2, 0, 4});
  const auto b = make("b", {0, 2, 6, 9});
  EXPECT_THAT(merge_films(std::vector{a, b}).missing,
              HasSubstr("--tile 1/2 --samples 4:6, --tile 1/2 --samples 9:10, --tile 2/2 --samples 0:10"));
  const auto c = make("c", {2, 3, 0, 10});
  EXPECT_THAT(merge_films(std::vector{c}).missing, HasSubstr("--tile 1/3 --samples 0:10, --tile 2/3 --samples 0:10"));
  // Shares of 5 and 7 have none in common with fewer than the 12 tiles.
  const std::string missing = merge_films(std::vector{make("d", {0, 5, 0, 10}), make("e", {1, 7, 0, 10})}).missing;
  EXPECT_THAT(missing, HasSubstr("no part holds --tile 3/12 --samples 0:10, --tile 4/12"));
  EXPECT_THAT(missing, HasSubstr("and 3 more"));  // d has 1, 6, 11 and e 2, 9
}

TEST_F(Merge, UnfinishedFilmsAreNamed) {
  std::stop_source source;
  ProgressReporter progress;
  progress.stop = source.get_token();
  progress.report = [&](std::uint64_t /*done*/, std::uint64_t /*total*/) { source.request_stop(); };
  const auto unfinished = make("unfinished", {0, 2, 0, 10}, progress);
  const auto other = make("other", {1, 2, 0, 10});
  EXPECT_THAT(merge_films(std::vector{unfinished, other}).missing, HasSubstr("unfinished is unfinished"));
}

TEST_F(Merge, FilmsOfOtherPicturesAreRefused) {
  const auto first = make("first", {0, 2, 0, 10});
  const auto message = [&] { return error_of({first, make("second", {1, 2, 0, 10})}); };
  EXPECT_EQ(message(), "no error");
  settings_.seed = 2;
  EXPECT_THAT(message(), AllOf(HasSubstr("second: is of another picture than"), HasSubstr("seed 2 instead of 0")));
  settings_.seed = 0;
  settings_.max_depth = 3;
  EXPECT_THAT(message(), HasSubstr("max-depth 3 instead of 8"));
  settings_.max_depth = 8;
  settings_.samples_per_pixel = 12;
  EXPECT_THAT(message(), HasSubstr("12 samples per pixel instead of 10"));
  settings_.samples_per_pixel = 10;
  settings_.width = 51;
  EXPECT_THAT(message(), HasSubstr("width 51 instead of 50"));
  settings_.width = 50;
  scene_.cameras.front().field_of_view = 0.69F;
  EXPECT_THAT(message(), HasSubstr("camera "));
  scene_.cameras.front().field_of_view = 0.7F;
  scene_.materials.front().base_colour.value.y = 0.71F;
  EXPECT_THAT(message(), HasSubstr("scene contents "));
}

}  // namespace
}  // namespace grove
