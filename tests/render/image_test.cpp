// Pictures out, read back with the readers of the scene room.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "grove/base/error.h"
#include "grove/render/image/colour_map.h"
#include "grove/render/image/tone_map.h"
#include "grove/render/image/write_exr.h"
#include "grove/render/image/write_png.h"
#include "grove/scene/read_image.h"

namespace grove {
namespace {

class Pictures : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    directory_ = std::filesystem::path(::testing::TempDir()) / (std::string("grove_picture_") + info->name());
    std::filesystem::remove_all(directory_);
    std::filesystem::create_directories(directory_);
    result_.film = Film(5, 3);
    for (std::uint32_t y = 0; y < 3; ++y) {
      for (std::uint32_t x = 0; x < 5; ++x) {
        const Vec3 base(static_cast<float>(x), static_cast<float>(y), 0.25F);
        result_.film.add(x, y, {.radiance = base, .albedo = 0.1F * base, .normal = {0.0F, 0.6F, -0.8F}});
      }
    }
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  std::filesystem::path directory_;
  RenderResult result_;
};

TEST_F(Pictures, ExrKeepsColoursAndLayersExactly) {
  const std::filesystem::path path = directory_ / "film.exr";
  write_exr(result_, LayerSet::usual(), path);
  Imf::InputFile file(path.string().c_str());
  const std::vector<std::string> names = {"R", "G", "B", "albedo.R", "albedo.G", "albedo.B", "normal.X", "normal.Y", "normal.Z"};
  std::vector<std::vector<float>> planes(names.size(), std::vector<float>(15));
  Imf::FrameBuffer frame;
  for (std::size_t i = 0; i < names.size(); ++i) {
    ASSERT_NE(file.header().channels().findChannel(names[i].c_str()), nullptr) << names[i];
    frame.insert(names[i].c_str(), Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(planes[i].data()), sizeof(float), 5 * sizeof(float)));
  }
  file.setFrameBuffer(frame);
  file.readPixels(0, 2);
  for (std::uint32_t y = 0; y < 3; ++y) {
    for (std::uint32_t x = 0; x < 5; ++x) {
      const Film::Sample mean = result_.film.mean(x, y);
      const std::size_t i = y * 5 + x;
      for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(planes[static_cast<std::size_t>(c)][i], mean.radiance[c]);
        EXPECT_EQ(planes[static_cast<std::size_t>(c) + 3][i], mean.albedo[c]);
        EXPECT_EQ(planes[static_cast<std::size_t>(c) + 6][i], mean.normal[c]);
      }
    }
  }
}

TEST_F(Pictures, PngIsEncodedInSrgb) {
  const std::filesystem::path path = directory_ / "film.png";
  result_.film = Film(3, 2);
  result_.film.add(0, 0, {.radiance = Vec3(1.0F, 0.0F, 0.0F)});
  result_.film.add(1, 0, {.radiance = Vec3(0.5F)});
  result_.film.add(2, 1, {.radiance = Vec3(0.0F, 0.25F, 4.0F)});
  write_png(result_, {.exposure = 0.0F, .tone_map = ToneMap::none}, path);
  const Image image = read_image(path);
  ASSERT_EQ(image.width, 3U);
  ASSERT_EQ(image.height, 2U);
  ASSERT_EQ(image.channels, 3U);
  EXPECT_EQ(image.bytes[0], 255);
  EXPECT_EQ(image.bytes[1], 0);
  EXPECT_EQ(image.bytes[3], 188);  // half of the light
  EXPECT_EQ(image.bytes[3 * 5 + 1], 137);
  EXPECT_EQ(image.bytes[3 * 5 + 2], 255);
  EXPECT_EQ(image.bytes[3 * 3], 0);  // no samples
  // One stop more doubles the light.
  write_png(result_, {.exposure = 1.0F, .tone_map = ToneMap::none}, path);
  EXPECT_EQ(read_image(path).bytes[3 * 5 + 1], 188);
}

TEST_F(Pictures, UnwritablePlacesAreReportedByName) {
  for (const std::filesystem::path& path : {directory_ / "none" / "film.exr", directory_}) {
    const auto failure = ::testing::ThrowsMessage<OutputError>(::testing::HasSubstr(path.string()));
    EXPECT_THAT([&] { write_exr(result_, LayerSet::usual(), path); }, failure);
    EXPECT_THAT([&] { write_png(result_, {}, path); }, failure);
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory_), std::filesystem::directory_iterator()), 0);
}

TEST_F(Pictures, OldPictureIsReplacedWhole) {
  const std::filesystem::path path = directory_ / "film.png";
  std::ofstream(path) << std::string(100000, 'x');
  write_png(result_, {}, path);
  EXPECT_EQ(read_image(path).width, 5U);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory_), std::filesystem::directory_iterator()), 1);
}

TEST(ToneMap, CurvesKeepBlackAndMiddleGreyAndRise) {
  for (const ToneMap curve : {ToneMap::filmic, ToneMap::aces}) {
    EXPECT_EQ(tone_map(curve, Vec3(0.0F)), Vec3(0.0F));
    EXPECT_NEAR(tone_map(curve, Vec3(0.18F)).y, 0.18F, 0.0002F);
    float previous = 0.0F;
    for (float x = 0.01F; x < 100.0F; x *= 1.3F) {
      const float y = tone_map(curve, Vec3(x)).x;
      EXPECT_GE(y, previous);
      EXPECT_LE(y, 1.0F);
      previous = y;
    }
    EXPECT_EQ(tone_map(curve, Vec3(1e30F)).x, 1.0F);
    EXPECT_EQ(tone_map(curve, Vec3(std::nanf(""))), Vec3(0.0F));
  }
  EXPECT_EQ(tone_map(ToneMap::none, Vec3(-1.0F, 0.3F, 7.0F)), Vec3(0.0F, 0.3F, 1.0F));
}

TEST(ToneMap, NamesLeadBack) {
  for (std::size_t i = 0; i < tone_map_names().size(); ++i) EXPECT_EQ(static_cast<std::size_t>(tone_map_from_name(tone_map_names()[i])), i);
  EXPECT_THAT([] { (void)tone_map_from_name("agfa"); }, ::testing::ThrowsMessage<UsageError>(::testing::HasSubstr("filmic")));
}

TEST(Srgb, EveryCodeComesBack) {
  for (int code = 0; code < 256; ++code) {
    const float encoded = static_cast<float>(code) / 255.0F;
    EXPECT_EQ(std::lround(255.0F * encode_srgb(decode_srgb(encoded))), code);
    EXPECT_NEAR(encode_srgb(decode_srgb(encoded)), encoded, 1.2e-7F) << code;
  }
}

TEST(Srgb, PiecesMeetWithoutAStep) {
  // Over the joint, wherever within the standard's rounding it lies, one float after the other.
  float previous = encode_srgb(0.0031304F);
  for (float x = 0.0031304F; x < 0.0031312F; x = std::nextafter(x, 1.0F)) {
    const float y = encode_srgb(x);
    EXPECT_GE(y, previous);
    EXPECT_LT(y - previous, 1e-8F);
    EXPECT_NEAR(y, 12.92F * x, 4e-7F);
    previous = y;
  }
  EXPECT_FLOAT_EQ(encode_srgb(0.001F), 0.01292F);
  EXPECT_FLOAT_EQ(encode_srgb(0.5F), 0.735356983F);
  EXPECT_NEAR(decode_srgb(0.04045F), 0.0031308F, 1e-8F);
  EXPECT_EQ(encode_srgb(1.0F), 1.0F);
  EXPECT_EQ(encode_srgb(2.0F), 1.0F);
  EXPECT_EQ(encode_srgb(std::nanf("")), 0.0F);
}

TEST(ColourMap, LightnessRises) {
  const auto linear = [](float encoded) { return encoded <= 0.04045F ? encoded / 12.92F : std::pow((encoded + 0.055F) / 1.055F, 2.4F); };
  float previous = -1.0F;
  for (int i = 0; i <= 50; ++i) {
    const Vec3 colour = colour_map(static_cast<float>(i) / 50.0F);
    const float light = 0.2126F * linear(colour.x) + 0.7152F * linear(colour.y) + 0.0722F * linear(colour.z);
    EXPECT_GT(light, previous) << i;
    previous = light;
  }
  EXPECT_EQ(colour_map(-1.0F), colour_map(0.0F));
  EXPECT_EQ(colour_map(std::nanf("")), colour_map(0.0F));
  EXPECT_EQ(colour_map(7.0F), colour_map(1.0F));
}

}  // namespace
}  // namespace grove
