#include "grove/scene/read_image.h"

#include <OpenEXR/ImfArray.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "grove/base/error.h"
#include "grove/base/random.h"
#include "scene/gltf_file.h"

namespace grove {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::span<const std::byte> as_bytes(const std::string& text) {
  return std::as_bytes(std::span(text));
}

template <typename Value>
std::string raw(const std::vector<Value>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)};
}

std::string small_bmp() {
  const std::vector<std::uint8_t> bytes = {'B', 'M', 62, 0, 0, 0, 0, 0, 0, 0, 54, 0, 0, 0, 40, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 1, 0, 24, 0,
                                           0, 0, 0, 0, 8, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
                                           // Rows from the bottom up, blue first, padded to four bytes.
                                           1, 2, 3, 0, 4, 5, 6, 0};
  return raw(bytes);
}

std::string small_tga() {
  std::vector<std::uint8_t> bytes(18, 0);
  bytes[2] = 3;  // grey
  bytes[12] = 2;
  bytes[14] = 1;
  bytes[16] = 8;
  bytes[17] = 0x20;  // from the top down
  bytes.push_back(7);
  bytes.push_back(9);
  return raw(bytes);
}

std::string small_hdr() {
  return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n" + std::string("\x80\x40\x20\x82", 4);
}

std::string small_pfm(bool big_endian) {
  std::string text = std::string("PF\n1 2\n") + (big_endian ? "1.0\n" : "-1.0\n");
  for (const float value : {1.0F, 2.0F, 3.0F, 4.0F, 5.0F, 6.0F}) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    for (int i = 0; i < 4; ++i) text += static_cast<char>(bits >> (8 * (big_endian ? 3 - i : i)));
  }
  return text;
}

class ReadImage : public ::testing::Test {
 protected:
  ReadImage()
      : folder_(std::filesystem::path(::testing::TempDir()) /
                (std::string("grove_") + ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::create_directories(folder_);
  }
  ~ReadImage() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return folder_ / name;
  }

  // Half or float channels R, G, B, A, each the channel's number plus x plus 10 y, in a data window that does not start at 0.
  std::filesystem::path write_exr(const std::vector<const char*>& channels, int width, int height, Imf::Compression compression) const {
    const Imath::Box2i window({-3, 5}, {-3 + width - 1, 5 + height - 1});
    Imf::Header header(window, window);
    header.compression() = compression;
    std::vector<float> pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * channels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const std::size_t pixel = i / channels.size();
      const auto stride = static_cast<std::size_t>(width);
      pixels[i] = static_cast<float>(i % channels.size() + pixel % stride + 10 * (pixel / stride));
    }
    Imf::FrameBuffer frame;
    const std::size_t step = channels.size() * sizeof(float);
    for (std::size_t c = 0; c < channels.size(); ++c) {
      header.channels().insert(channels[c], Imf::Channel(Imf::FLOAT));
      frame.insert(channels[c], Imf::Slice::Make(Imf::FLOAT, pixels.data() + c, window, step, step * static_cast<std::size_t>(width)));
    }
    const std::filesystem::path file = folder_ / "image.exr";
    Imf::OutputFile output(file.c_str(), header, 0);
    output.setFrameBuffer(frame);
    output.writePixels(height);
    return file;
  }

  std::filesystem::path folder_;
};

std::string message_of(const std::string& content) {
  try {
    (void)decode_image(as_bytes(content), "picture");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST_F(ReadImage, PngKeepsBytesWithTheTopRowFirst) {
  const Image image = read_image(write("image.png", raw(small_png())));
  EXPECT_EQ(image.width, 2U);
  EXPECT_EQ(image.height, 2U);
  EXPECT_EQ(image.channels, 3U);
  EXPECT_FALSE(image.is_float());
  EXPECT_THAT(image.bytes, ElementsAre(255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255));
}

TEST_F(ReadImage, BmpAndTga) {
  EXPECT_THAT(decode_image(as_bytes(small_bmp()), "a").bytes, ElementsAre(6, 5, 4, 3, 2, 1));
  const Image grey = decode_image(as_bytes(small_tga()), "b");
  EXPECT_EQ(grey.channels, 1U);
  EXPECT_THAT(grey.bytes, ElementsAre(7, 9));
}

TEST_F(ReadImage, HdrGivesLinearFloats) {
  // Shared exponent 0x82: mantissa / 256 * 2^2.
  EXPECT_THAT(decode_image(as_bytes(small_hdr()), "a").floats, ElementsAre(2.0F, 1.0F, 0.5F));
}

TEST_F(ReadImage, PfmInBothByteOrdersTurnsRowsOver) {
  for (const bool big_endian : {false, true}) {
    const Image image = decode_image(as_bytes(small_pfm(big_endian)), "a");
    EXPECT_EQ(image.height, 2U);
    EXPECT_THAT(image.floats, ElementsAre(4.0F, 5.0F, 6.0F, 1.0F, 2.0F, 3.0F));
  }
}

TEST_F(ReadImage, ExrWithColourAndAlpha) {
  const Image image = read_image(write_exr({"R", "G", "B", "A"}, 3, 2, Imf::ZIP_COMPRESSION));
  EXPECT_EQ(image.width, 3U);
  EXPECT_EQ(image.height, 2U);
  EXPECT_EQ(image.channels, 4U);
  ASSERT_EQ(image.floats.size(), 24U);
  EXPECT_EQ(image.floats[0], 0.0F);
  EXPECT_EQ(image.floats[3], 3.0F);
  EXPECT_EQ(image.floats[(1 * 3 + 2) * 4 + 1], 13.0F);
}

TEST_F(ReadImage, ExrWithLuminanceOnly) {
  const Image image = read_image(write_exr({"Y"}, 2, 2, Imf::PIZ_COMPRESSION));
  EXPECT_EQ(image.channels, 1U);
  EXPECT_THAT(image.floats, ElementsAre(0.0F, 1.0F, 10.0F, 11.0F));
}

TEST_F(ReadImage, ExrWithoutColourIsAnError) {
  const std::filesystem::path file = write_exr({"Z"}, 2, 2, Imf::NO_COMPRESSION);
  EXPECT_THROW(
      try { (void)read_image(file); } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("image.exr"));
        EXPECT_THAT(error.what(), HasSubstr("channels R, G and B, or Y"));
        throw;
      },
      InputError);
}

TEST_F(ReadImage, ErrorsNameTheFileAndTheProblem) {
  EXPECT_THAT(message_of(""), HasSubstr("picture: an empty image file"));
  EXPECT_THAT(message_of("this is a text"), HasSubstr("not an image"));
  EXPECT_THAT(message_of("PF\nwide 2\n1\n"), HasSubstr("expected width, height and scale"));
  EXPECT_THAT(message_of("PF\n0 2\n1\n"), HasSubstr("without pixels"));
  EXPECT_THAT(message_of("PF\n4 4\n-1\nabc"), HasSubstr("more than its"));
  EXPECT_THAT(message_of("Pf\n2 2\n-1\nabcdabcdabcdabc"), HasSubstr("cut short"));
  EXPECT_THAT(message_of("PF\n4000000000 4000000000\n-1\n"), HasSubstr("limit is 2^28"));
  EXPECT_THROW((void)read_image(folder_ / "absent.png"), InputError);
  EXPECT_THROW((void)read_image(folder_), InputError);
}

TEST_F(ReadImage, HeadersThatClaimTooMuchAskForNoMemory) {
  std::string png = raw(small_png());
  png[16] = 0;
  png[17] = 0;
  png[18] = 0x3f;
  png[22] = 0x3f;
  EXPECT_THAT(message_of(png), HasSubstr("more than its"));

  std::ifstream stream(write_exr({"Y"}, 2, 2, Imf::NO_COMPRESSION), std::ios::binary);
  std::string exr((std::istreambuf_iterator<char>(stream)), {});
  const std::size_t window = exr.find("dataWindow") + std::strlen("dataWindow") + 1 + std::strlen("box2i") + 1 + 4;
  exr[window + 14] = 0x7f;
  EXPECT_THAT(message_of(exr), HasSubstr("picture: "));
}

// Whatever the bytes, an image or an InputError; run under the address sanitiser this finds reads outside the buffers.
TEST_F(ReadImage, DamagedFilesGiveAnImageOrAnError) {
  std::ifstream stream(write_exr({"R", "G", "B"}, 9, 7, Imf::ZIP_COMPRESSION), std::ios::binary);
  const std::string exr((std::istreambuf_iterator<char>(stream)), {});
  constexpr std::uint64_t kSeed = 20;
  Random random(kSeed);
  for (const std::string& whole : {raw(small_png()), small_bmp(), small_tga(), small_hdr(), small_pfm(true), exr}) {
    for (int variant = 0; variant < fuzz_variants(200); ++variant) {
      std::string damaged = whole;
      for (std::uint32_t flip = random.next_u32(4); flip < 4; ++flip) {
        damaged[random.next_u32(static_cast<std::uint32_t>(damaged.size()))] = static_cast<char>(random.next_u32(256));
      }
      if (random.next_u32(3) == 0) damaged.resize(random.next_u32(static_cast<std::uint32_t>(damaged.size())));
      try {
        const Image image = decode_image(as_bytes(damaged), "damaged");
        EXPECT_EQ(image.bytes.size() + image.floats.size(), std::size_t{image.width} * image.height * image.channels);
      } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("damaged")) << "seed " << kSeed << ", variant " << variant;
      }
    }
  }
}

TEST_F(ReadImage, SharedScenes) {
  const std::filesystem::path scenes = std::filesystem::path(GROVE_SOURCE_DIR) / ".." / "shared" / "scenes";
  if (!std::filesystem::exists(scenes)) GTEST_SKIP() << "no ../shared/scenes beside the source tree";
  const Image sky = read_image(scenes / "classroom/textures/Skydome.pfm");
  EXPECT_TRUE(sky.is_float());
  EXPECT_EQ(sky.channels, 3U);
  EXPECT_EQ(sky.floats.size(), std::size_t{sky.width} * sky.height * 3);
  const Image board = read_image(scenes / "classroom/textures/blackboard.jpg");
  EXPECT_EQ(board.channels, 3U);
  EXPECT_FALSE(board.bytes.empty());
}

}  // namespace
}  // namespace grove
