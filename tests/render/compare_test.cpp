// Measures of difference between pictures, against what can be worked out by hand.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "grove/base/error.h"
#include "grove/render/compare/flip.h"
#include "grove/render/compare/opponent_colours.h"
#include "grove/render/compare/picture_difference.h"

namespace grove {
namespace {

ColourImage plain(std::uint32_t width, std::uint32_t height, const Vec3& colour) {
  ColourImage image(width, height);
  for (Vec3& pixel : image.pixels) pixel = colour;
  return image;
}

// Something with edges, gradients and colours.
ColourImage pattern() {
  ColourImage image(40, 24);
  for (std::uint32_t y = 0; y < 24; ++y) {
    for (std::uint32_t x = 0; x < 40; ++x) {
      const auto u = static_cast<float>(x) / 40.0F;
      const auto v = static_cast<float>(y) / 24.0F;
      image.at(x, y) = (x / 8 + y / 6) % 2 == 0 ? Vec3(u, v, 0.3F) : Vec3(0.2F * v, 0.7F, 1.0F - u);
    }
  }
  return image;
}

double mean(const Plane& plane) {
  double sum = 0.0;
  for (const float value : plane) sum += value;
  return sum / static_cast<double>(plane.size());
}

TEST(Flip, IsNothingForEqualPicturesAndOneForTheWorstColours) {
  EXPECT_EQ(mean(flip(pattern(), pattern())), 0.0);
  // The largest difference that a screen can show, by definition.
  EXPECT_NEAR(mean(flip(plain(9, 9, {0, 1, 0}), plain(9, 9, {0, 0, 1}))), 1.0, 1e-5);
}

TEST(Flip, BlackAgainstWhiteIsAsThePaperDefines) {
  // A lightness of 100 apart: 100^0.7 lies above the knee at 0.4 of green against blue, whose distance is worked out here.
  const double largest = std::pow(hyab(to_hunt_lab({0, 1, 0}), to_hunt_lab({0, 0, 1})), 0.7);
  EXPECT_NEAR(largest, 41.27, 0.02);  // as in the authors' own remarks
  const double expected = 0.95 + 0.05 * (std::pow(100.0, 0.7) - 0.4 * largest) / (0.6 * largest);
  EXPECT_NEAR(mean(flip(plain(9, 9, Vec3(0.0F)), plain(9, 9, Vec3(1.0F)))), expected, 1e-4);
  // Below the knee it is straight: lightness 50 against 51.
  const auto grey = [](float lightness) { return plain(9, 9, Vec3(std::pow((lightness + 16.0F) / 116.0F, 3.0F))); };
  EXPECT_NEAR(mean(flip(grey(50.0F), grey(51.0F))), 0.95 / (0.4 * largest), 1e-3);
}

TEST(Flip, AnEdgeIsSeenMoreThanTheColourAlone) {
  ColourImage edge = plain(32, 32, Vec3(0.5F));
  for (std::uint32_t y = 0; y < 32; ++y)
    for (std::uint32_t x = 16; x < 32; ++x) edge.at(x, y) = Vec3(0.55F);
  const Plane difference = flip(plain(32, 32, Vec3(0.5F)), edge);
  EXPECT_EQ(difference[16 * 32], 0.0F) << "no difference far to the left";
  EXPECT_GT(difference[16 * 32 + 16], 1.2F * difference[16 * 32 + 31]);
}

TEST(Flip, LooksAtASmallerPictureWhenPixelsAreSmaller) {
  // Single bright pixels vanish for an eye that is far away.
  ColourImage dots = plain(48, 48, Vec3(0.2F));
  for (std::uint32_t y = 0; y < 48; y += 4)
    for (std::uint32_t x = 0; x < 48; x += 4) dots.at(x, y) = Vec3(0.5F);
  const ColourImage blank = plain(48, 48, Vec3(0.2F + 0.3F / 16.0F));
  EXPECT_LT(mean(flip(blank, dots, 160.0F)), 0.5 * mean(flip(blank, dots, 20.0F)));
}

TEST(HdrFlip, SeesWhatOneExposureHides) {
  // Both are white at an exposure of 0.
  const ColourImage a = plain(9, 9, Vec3(50.0F));
  const ColourImage b = plain(9, 9, Vec3(80.0F));
  EXPECT_EQ(mean(flip(a, b)), 0.0);
  EXPECT_GT(mean(hdr_flip(a, b).difference), 0.05);
  EXPECT_EQ(mean(hdr_flip(a, a).difference), 0.0);
}

TEST(HdrFlip, ExposuresFollowTheReference) {
  ColourImage reference = plain(9, 9, Vec3(0.5F));
  reference.at(0, 0) = Vec3(32.0F);
  const HdrFlip result = hdr_flip(reference, reference);
  // The brightest is 64 times the median: 6 stops.
  EXPECT_NEAR(result.last_exposure - result.first_exposure, 6.0F, 1e-4F);
  EXPECT_EQ(result.exposures, 6);
  const float x = 0.5F * std::exp2(result.last_exposure) * 0.6F;
  EXPECT_NEAR(x * (2.51F * x + 0.03F) / (x * (2.43F * x + 0.59F) + 0.14F), 0.85F, 1e-4F);
}

TEST(PictureDifference, IsWhatItsNamesSay) {
  const PictureDifference none = compare_pictures(pattern(), pattern(), 1.0F, ToneMap::aces);
  EXPECT_EQ(none.rmse, 0.0);
  EXPECT_EQ(none.relative_mse, 0.0);
  EXPECT_EQ(none.flip, 0.0);
  const PictureDifference some = compare_pictures(plain(8, 8, Vec3(2.0F)), plain(8, 8, Vec3(2.0F, 2.0F, 2.5F)), 1.0F, ToneMap::none);
  EXPECT_NEAR(some.rmse, std::sqrt(0.25 / 3.0), 1e-6);
  EXPECT_NEAR(some.relative_mse, 0.25 / 4.01 / 3.0, 1e-6);
  EXPECT_NEAR(some.relative_bias, 0.5 / 6.0, 1e-6);
  EXPECT_EQ(some.flip, 0.0) << "both are white on a screen";
  EXPECT_GT(some.hdr_flip, 0.0);
}

TEST(ReferencePicture, MustBeLightOfTheSameSize) {
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "grove_reference.pfm";
  {
    std::ofstream stream(file, std::ios::binary);
    stream << "PF\n2 1\n-1.0\n";
    const float values[6] = {0.0F, 1.0F, 2.0F, 3.0F, 4.0F, 5.0F};
    stream.write(reinterpret_cast<const char*>(values), sizeof values);
  }
  EXPECT_EQ(read_reference(file, 2, 1).at(1, 0), Vec3(3.0F, 4.0F, 5.0F));
  const auto failure = ::testing::ThrowsMessage<InputError>(
      ::testing::AllOf(::testing::HasSubstr(file.string()), ::testing::HasSubstr("2 x 1"), ::testing::HasSubstr("3 x 1")));
  EXPECT_THAT([&] { (void)read_reference(file, 3, 1); }, failure);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace grove
