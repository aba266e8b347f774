// Ray and hit files: what is written can be read again, and whatever is malformed is refused with one line.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <sstream>

#include "grove/base/error.h"
#include "grove/base/random.h"
#include "grove/lab/npy_header.h"
#include "grove/lab/ray_file.h"
#include "lab/temporary_directory.h"

namespace grove {
namespace {

using ::testing::HasSubstr;
using testing::read_file;
using testing::TemporaryDirectory;
using testing::write_file;

std::vector<Ray> some_rays(std::size_t count) {
  Random random(3);
  std::vector<Ray> rays(count);
  for (Ray& ray : rays) {
    for (int axis = 0; axis < 3; ++axis) {
      ray.origin[axis] = random.next_float(-1.0F, 1.0F);
      ray.direction[axis] = random.next_float(-1.0F, 1.0F);
    }
    ray.t_min = random.next_float();
  }
  return rays;
}

/// A file with this header text in format `version` and this much data.
std::string npy_file(int version, std::string header, std::size_t data_size) {
  header += '\n';
  std::string file = "\x93NUMPY";
  file += static_cast<char>(version);
  file += '\0';
  const std::size_t length_size = version == 1 ? 2 : 4;
  for (std::size_t i = 0; i < length_size; ++i) file += static_cast<char>(header.size() >> (8 * i) & 0xff);
  return file + header + std::string(data_size, '\0');
}

constexpr char kGoodHeader[] = "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 8), }";

TEST(RayFile, ReadsWhatWasWritten) {
  const TemporaryDirectory directory;
  for (const std::size_t count : {0U, 1U, 1000U}) {
    const std::vector<Ray> rays = some_rays(count);
    write_rays(directory / "rays.npy", rays);
    RayFile file(directory / "rays.npy");
    ASSERT_EQ(file.ray_count(), count);
    const std::vector<Ray> read = file.read();
    ASSERT_EQ(read.size(), count);
    EXPECT_TRUE(count == 0 || std::memcmp(read.data(), rays.data(), count * sizeof(Ray)) == 0);
  }
}

TEST(RayFile, ReadsEveryFormatVersion) {
  const TemporaryDirectory directory;
  for (const int version : {1, 2, 3}) {
    write_file(directory / "rays.npy", npy_file(version, kGoodHeader, 64));
    EXPECT_EQ(RayFile(directory / "rays.npy").ray_count(), 2U) << version;
  }
}

TEST(RayFile, ReadsHeadersSpacedAndQuotedOtherwise) {
  const TemporaryDirectory directory;
  write_file(directory / "rays.npy", npy_file(1, "{ \"shape\":(2,8),\"fortran_order\" :False , 'descr':'<f4'}", 64));
  EXPECT_EQ(RayFile(directory / "rays.npy").ray_count(), 2U);
}

struct Malformed {
  const char* name;
  std::string bytes;
  const char* message;
};

class MalformedRayFile : public ::testing::TestWithParam<Malformed> {};

TEST_P(MalformedRayFile, IsRefusedInOneLine) {
  const TemporaryDirectory directory;
  write_file(directory / "rays.npy", GetParam().bytes);
  try {
    const RayFile file(directory / "rays.npy");
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("rays.npy"));
    EXPECT_THAT(error.what(), HasSubstr(GetParam().message));
    EXPECT_THAT(error.what(), ::testing::Not(HasSubstr("\n")));
  }
}

std::vector<Malformed> malformed_files() {
  const auto header = [](const char* text) { return npy_file(1, text, 64); };
  const std::string good = npy_file(1, kGoodHeader, 64);
  return {
      {"Empty", "", "not a NumPy"},
      {"OtherFormat", "PK\x03\x04 an archive of arrays", "not a NumPy"},
      {"MagicOnly", good.substr(0, 6), "not a NumPy"},
      {"NoLength", good.substr(0, 9), "ends within"},
      {"CutHeader", good.substr(0, 30), "ends within"},
      {"CutData", good.substr(0, good.size() - 1), "should hold 2 rays"},
      {"ExtraData", good + "x", "should hold 2 rays"},
      {"Version4", npy_file(4, kGoodHeader, 64), "version 4"},
      {"HugeHeaderLength", npy_file(2, kGoodHeader, 64).replace(8, 4, "\xff\xff\xff\x7f"), "ends within"},
      {"LongHeader", npy_file(2, kGoodHeader + std::string(20'000, ' '), 64), "cannot be right"},
      {"BigEndian", header("{'descr': '>f4', 'fortran_order': False, 'shape': (2, 8), }"), "big-endian"},
      {"Double", header("{'descr': '<f8', 'fortran_order': False, 'shape': (1, 8), }"), "<f8"},
      {"Structured", header("{'descr': [('t', '<f4'), ('u', '<f4')], 'fortran_order': False, 'shape': (8,), }"), "[('t', '<f4')"},
      {"Fortran", header("{'descr': '<f4', 'fortran_order': True, 'shape': (2, 8), }"), "Fortran"},
      {"Flat", header("{'descr': '<f4', 'fortran_order': False, 'shape': (16,), }"), "(16,)"},
      {"SixColumns", header("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 6), }"), "(2, 6)"},
      {"Scalar", header("{'descr': '<f4', 'fortran_order': False, 'shape': (), }"), "()"},
      {"HugeCount", header("{'descr': '<f4', 'fortran_order': False, 'shape': (2305843009213693954, 8), }"), "should hold"},
      {"CountBeyond64Bits", header("{'descr': '<f4', 'fortran_order': False, 'shape': (99999999999999999999, 8), }"), "broken"},
      {"NegativeCount", header("{'descr': '<f4', 'fortran_order': False, 'shape': (-2, 8), }"), "broken"},
      {"NoDictionary", header("float32"), "broken"},
      {"NoShape", header("{'descr': '<f4', 'fortran_order': False, }"), "broken"},
      {"UnknownKey", header("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 8), 'more': 1, }"), "broken"},
      {"OpenString", header("{'descr': '<f4, "), "broken"},
      {"OpenList", header("{'descr': [('t', '<f4'"), "broken"},
      {"OpenTuple", header("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 8"), "broken"},
      {"TextAfter", header("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 8), } more"), "broken"},
      {"NoCommas", header("{'descr': '<f4' 'fortran_order': False 'shape': (2 8)}"), "broken"},
      {"BadBool", header("{'descr': '<f4', 'fortran_order': 0, 'shape': (2, 8), }"), "broken"},
  };
}

INSTANTIATE_TEST_SUITE_P(All, MalformedRayFile, ::testing::ValuesIn(malformed_files()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(RayFile, RefusesMissingFilesAndDirectories) {
  const TemporaryDirectory directory;
  EXPECT_THROW(RayFile(directory / "none.npy"), InputError);
  EXPECT_THROW(RayFile(directory.path()), InputError);
}

TEST(RayFile, NoByteOfTheHeaderCanBreakIt) {
  // Every one-byte change either gives an InputError or a file of the same two rays.
  const TemporaryDirectory directory;
  const std::string good = npy_file(1, kGoodHeader, 64);
  const std::uint64_t seed = 11;
  SCOPED_TRACE(seed);
  Random random(seed);
  for (std::size_t i = 0; i < good.size() - 64; ++i) {
    for (int change = 0; change < 8; ++change) {
      std::string bytes = good;
      bytes[i] = static_cast<char>(random.next_u32(256));
      write_file(directory / "rays.npy", bytes);
      try {
        EXPECT_EQ(RayFile(directory / "rays.npy").read().size(), 2U);
      } catch (const InputError&) {
      }
    }
  }
}

TEST(HitFile, HasTheAgreedType) {
  const TemporaryDirectory directory;
  const std::vector<Hit> hits{{1.0F, 0.25F, 0.5F, 7, 8, 9}, {}};
  write_hits(directory / "hits.npy", hits);
  const std::string bytes = read_file(directory / "hits.npy");
  std::istringstream stream(bytes);
  const NpyHeader header = read_npy_header(stream, "hits.npy", bytes.size());
  EXPECT_EQ(header.descr, "[('t', '<f4'), ('u', '<f4'), ('v', '<f4'), ('primitive', '<u4'), ('geometry', '<u4'), ('instance', '<u4')]");
  EXPECT_FALSE(header.fortran_order);
  EXPECT_THAT(header.shape, ::testing::ElementsAre(2U));
  EXPECT_EQ(header.data_offset % 64, 0U);
  ASSERT_EQ(bytes.size(), header.data_offset + 48);
  EXPECT_EQ(std::memcmp(bytes.data() + header.data_offset, hits.data(), 48), 0);
}

}  // namespace
}  // namespace grove
