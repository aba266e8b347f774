#include "grove/scene/read_ply.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>

#include "grove/scene/load.h"
#include "scene/temporary_file.h"

namespace grove {
namespace {

using testing::HasSubstr;

constexpr std::string_view kSquare =
    "ply\nformat ascii 1.0\ncomment a square\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";

PlyMesh read_text(std::string_view content) {
  const TemporaryFile file("mesh.ply", content);
  return read_ply(file.path());
}

std::string error_of(std::string_view content) {
  return input_error_of([&] { (void)read_text(content); });
}

template <typename T>
void append(std::string& bytes, T value, bool big_endian) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (big_endian != (std::endian::native == std::endian::big)) std::reverse(raw, raw + sizeof(T));
  bytes.append(raw, sizeof(T));
}

std::string gzipped(const std::string& content) {
  const TemporaryFile file("data.gz", "");
  gzFile out = gzopen(file.path().c_str(), "wb");
  gzwrite(out, content.data(), static_cast<unsigned>(content.size()));
  gzclose(out);
  std::ifstream in(file.path(), std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Ply, ReadsTextAndCutsASquareInTwo) {
  const PlyMesh mesh = read_text(kSquare);
  ASSERT_EQ(mesh.vertices.size(), 4U);
  EXPECT_EQ(mesh.vertices[2], Vec3(1, 1, 0));
  ASSERT_EQ(mesh.triangles.size(), 2U);
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_TRUE(mesh.uvs.empty());
  EXPECT_TRUE(mesh.colours.empty());
}

// One file in every encoding: properties out of order, an unknown list inside the vertices, an unknown element, wide and narrow types.
class PlyEncodingTest : public testing::TestWithParam<bool> {};

TEST_P(PlyEncodingTest, ReadsAnyTypesAndOrder) {
  const bool big = GetParam();
  std::string data =
      std::string("ply\r\nformat ") + (big ? "binary_big_endian" : "binary_little_endian") +
      " 1.0\r\nelement junk 2\r\nproperty list ushort double stuff\r\nproperty char c\r\n"
      "element vertex 3\r\nproperty double z\r\nproperty list int short extra\r\nproperty float64 x\r\nproperty uchar red\r\n"
      "property uchar green\r\nproperty uchar blue\r\nproperty short y\r\nproperty float s\r\nproperty float t\r\n"
      "property float nx\r\nproperty float ny\r\nproperty float nz\r\n"
      "element face 1\r\nproperty float quality\r\nproperty list uint ushort vertex_index\r\nend_header\r\n";
  for (int i = 0; i < 2; ++i) {
    append<std::uint16_t>(data, 2, big);
    append<double>(data, 1.5, big);
    append<double>(data, 2.5, big);
    append<std::int8_t>(data, -1, big);
  }
  for (int i = 0; i < 3; ++i) {
    append<double>(data, 10.0 + i, big);
    append<std::int32_t>(data, i, big);
    for (int k = 0; k < i; ++k) append<std::int16_t>(data, -7, big);
    append<double>(data, i == 1 ? 1.0 : 0.0, big);
    append<std::uint8_t>(data, 255, big);
    append<std::uint8_t>(data, 0, big);
    append<std::uint8_t>(data, 188, big);
    append<std::int16_t>(data, static_cast<std::int16_t>(-i), big);
    append<float>(data, 0.25F, big);
    append<float>(data, 0.75F, big);
    for (const float n : {0.0F, 0.0F, 1.0F}) append<float>(data, n, big);
  }
  append<float>(data, 9.0F, big);
  append<std::uint32_t>(data, 3, big);
  for (const std::uint16_t i : {2, 1, 0}) append<std::uint16_t>(data, i, big);

  for (const std::string& content : {data, gzipped(data)}) {
    const PlyMesh mesh = read_text(content);
    ASSERT_EQ(mesh.vertices.size(), 3U);
    EXPECT_EQ(mesh.vertices[1], Vec3(1, -1, 11));
    EXPECT_EQ(mesh.vertices[2], Vec3(0, -2, 12));
    EXPECT_EQ(mesh.normals[2], Vec3(0, 0, 1));
    EXPECT_EQ(mesh.uvs[0], Vec2(0.25F, 0.75F));
    // sRGB 188 is half of the light.
    EXPECT_EQ(mesh.colours[0].x, 1.0F);
    EXPECT_EQ(mesh.colours[0].y, 0.0F);
    EXPECT_NEAR(mesh.colours[0].z, 0.5F, 0.005F);
    EXPECT_EQ(mesh.colours[0].w, 1.0F);
    ASSERT_EQ(mesh.triangles.size(), 1U);
    EXPECT_EQ(mesh.triangles[0], Triangle(2, 1, 0));
  }
}

INSTANTIATE_TEST_SUITE_P(ByteOrders, PlyEncodingTest, testing::Bool(), [](const auto& order) { return order.param ? "big" : "little"; });

TEST(Ply, ReadsFacesThatComeBeforeTheirVertices) {
  const PlyMesh mesh = read_text(
      "ply\nformat ascii 1.0\nelement face 2\nproperty list uchar int vertex_indices\nelement vertex 4\nproperty float x\n"
      "property float y\nproperty float z\nend_header\n3 0 1 2\n4 0 1 2 3\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n");
  EXPECT_EQ(mesh.vertices.size(), 4U);
  EXPECT_EQ(mesh.triangles.size(), 3U);
}

TEST(Ply, ReadsTriangleStrips) {
  const PlyMesh mesh = read_text(
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement tristrips 1\n"
      "property list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n8 0 1 2 3 -1 1 2 3\n");
  EXPECT_THAT(mesh.triangles, testing::ElementsAre(Triangle(0, 1, 2), Triangle(2, 1, 3), Triangle(1, 2, 3)));
}

TEST(Ply, RefusesWhatIsWrongAndSaysWhere) {
  EXPECT_THAT(error_of(""), HasSubstr("mesh.ply:line 1: the file is empty"));
  EXPECT_THAT(error_of("plx\n"), HasSubstr("not a PLY file"));
  EXPECT_THAT(error_of("ply\nformat ascii 1.0\n"), HasSubstr("cut short"));
  EXPECT_THAT(error_of("ply\nformat morse 1.0\n"), HasSubstr("'morse'"));
  EXPECT_THAT(error_of("ply\nformat ascii 1.0\nelement vertex -4\nend_header\n"), HasSubstr("'-4'"));
  EXPECT_THAT(error_of("ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n"), HasSubstr("'real'"));
  const std::string square(kSquare);
  EXPECT_THAT(error_of(square.substr(0, square.size() - 4)), HasSubstr("line 15"));
  EXPECT_THAT(error_of(std::string(square).replace(square.find("4 0 1 2 3"), 9, "4 0 1 2 4")), HasSubstr("vertex 4"));
  EXPECT_THAT(error_of(std::string(square).replace(square.find("4 0 1 2 3"), 9, "4 0 1 2 -")), HasSubstr("not an integer"));
  EXPECT_THAT(error_of(std::string(square).replace(square.find("1 1 0"), 5, "1 x 0")), HasSubstr("line 13: 'x' is not a number"));
  EXPECT_THAT(error_of(std::string(square).replace(square.find("float z"), 7, "float w")), HasSubstr("no x, y and z"));
}

// Memory is asked for only after the promise has been held against the file's length.
TEST(Ply, RefusesCountsThatTheFileCannotHold) {
  const std::string many =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  EXPECT_THAT(error_of(many), HasSubstr("4000000000 of element 'vertex'"));
  EXPECT_THAT(error_of(gzipped(many)), HasSubstr("4000000000 of element 'vertex'"));
  std::string list =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
      "property list uint int vertex_indices\nend_header\n";
  list += std::string(12, '\0') + std::string("\xf0\xff\xff\xff", 4) + std::string(8, '\0');
  EXPECT_THAT(error_of(list), HasSubstr("longer than the rest of the file"));
  EXPECT_THAT(error_of(gzipped(list)), HasSubstr("longer than the rest of the file"));
}

TEST(Ply, RefusesATruncatedGzipFile) {
  std::string square(kSquare);
  for (int i = 0; i < 2000; ++i) square.insert(square.find("element"), "comment " + std::to_string(i * 7919) + "\n");
  const std::string whole = gzipped(square);
  EXPECT_EQ(read_text(whole).triangles.size(), 2U);
  EXPECT_THAT(error_of(whole.substr(0, whole.size() / 2)), HasSubstr("cut short"));
}

TEST(Ply, SaysThatPointsAreNotRenderable) {
  const TemporaryFile file(
      "points.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 2 3\n");
  EXPECT_THAT(input_error_of([&] { (void)load_scene(file.path().string()); }), HasSubstr("nothing renderable"));
}

TEST(Ply, KeepsOutTrianglesThatCanNeverBeHit) {
  std::string content(kSquare);
  content.replace(content.find("1 1 0"), 5, "1e99 nan 0");
  const TemporaryFile nothing("square.ply", content);
  EXPECT_THAT(input_error_of([&] { (void)load_scene(nothing.path().string()); }), HasSubstr("nothing renderable"));
  content.replace(content.find("face 1"), 6, "face 2");
  const TemporaryFile file("square.ply", content + "3 0 1 3\n");
  const Scene scene = load_scene(file.path().string());
  EXPECT_EQ(scene.primitive_count(), 1U);
  EXPECT_THAT(scene.warnings, testing::ElementsAre(HasSubstr("2 triangles were left out")));
}

TEST(Ply, ReadsTheSharedScans) {
  const auto bunny = shared_scene("stanford-scans/bun_zipper.ply");
  if (!std::filesystem::exists(bunny)) GTEST_SKIP() << "the shared scenes are not there";
  EXPECT_EQ(load_scene(bunny.string()).primitive_count(), 69451U);
  const Scene hair = load_scene(shared_scene("hair-tuft/hair_tubes.ply.gz").string());
  EXPECT_EQ(hair.primitive_count(), 307200U);
  EXPECT_TRUE(hair.warnings.empty());
  EXPECT_GT(hair.load_seconds, 0.0);
}

TEST(Ply, TakesTrickyCoordinatesAndRefusesBrokenFiles) {
  if (!std::filesystem::exists(shared_scene("bad"))) GTEST_SKIP() << "the shared scenes are not there";
  for (const char* name : {"bad/huge_coordinates.ply", "bad/far_from_origin.ply", "bad/denormal_coordinates.ply"}) {
    const Scene scene = load_scene(shared_scene(name).string());
    EXPECT_EQ(scene.primitive_count(), 512U) << name;
    EXPECT_TRUE(scene.warnings.empty()) << name;
    EXPECT_FALSE(scene.bounds().is_empty()) << name;
  }
  const PlyMesh denormal = read_ply(shared_scene("bad/denormal_coordinates.ply"));
  EXPECT_TRUE(
      std::any_of(denormal.vertices.begin(), denormal.vertices.end(), [](const Vec3& v) { return std::fpclassify(v.x) == FP_SUBNORMAL; }));
  EXPECT_THAT(input_error_of([] { (void)load_scene(shared_scene("bad/empty.ply").string()); }), HasSubstr("empty"));
  EXPECT_THAT(input_error_of([] { (void)load_scene(shared_scene("bad/truncated_vertices.ply").string()); }), HasSubstr("cut short"));
}

// Whatever the bytes, a mesh whose indices are in range or an InputError.
TEST(Ply, SurvivesMutations) {
  std::string binary =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
      "property uchar green\nproperty uchar blue\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n";
  for (int i = 0; i < 4; ++i) {
    for (const float c : {static_cast<float>(i % 2), static_cast<float>(i / 2), 0.5F}) append<float>(binary, c, false);
    binary += "abc";
  }
  for (int face = 0; face < 2; ++face) {
    binary += '\4';
    for (const std::int32_t i : {0, 1, 3, 2}) append<std::int32_t>(binary, i, false);
  }
  const std::string squeezed = gzipped(binary);
  const TemporaryFile file("mutant.ply", "");
  int read = 0;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    const std::string& base = seed % 2 == 0 ? binary : std::string(kSquare);
    const std::string content = seed % 10 == 0 ? mutated(squeezed, seed) : mutated(base, seed);
    SCOPED_TRACE("seed " + std::to_string(seed));
    file.rewrite(content);
    try {
      const PlyMesh mesh = read_ply(file.path());
      for (const Triangle& t : mesh.triangles) ASSERT_LT(std::max({t.x, t.y, t.z}), mesh.vertices.size());
      ASSERT_TRUE(mesh.colours.empty() || mesh.colours.size() == mesh.vertices.size());
      ++read;
    } catch (const InputError& error) {
      ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
  EXPECT_GT(read, 30);
  EXPECT_LT(read, 550);
}

}  // namespace
}  // namespace grove
