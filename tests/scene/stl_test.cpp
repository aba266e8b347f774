#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <limits>
#include <string>

#include "grove/scene/load.h"
#include "scene/temporary_file.h"

namespace grove {
namespace {

using testing::HasSubstr;

constexpr Vec3 kTetrahedron[4] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
constexpr int kFaces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

void append_u32(std::string& bytes, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> (8 * i));
}

std::string binary_tetrahedron(const std::string& header = "made by a test") {
  std::string bytes = header;
  bytes.resize(80, ' ');
  append_u32(bytes, 4);
  for (const auto& face : kFaces) {
    bytes.append(12, '\0');
    for (const int corner : face) {
      for (int axis = 0; axis < 3; ++axis) append_u32(bytes, std::bit_cast<std::uint32_t>(kTetrahedron[corner][axis]));
    }
    bytes.append(2, '\0');
  }
  return bytes;
}

std::string text_tetrahedron() {
  std::string text = "solid tetrahedron\n";
  for (const auto& face : kFaces) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int corner : face) {
      const Vec3& p = kTetrahedron[corner];
      text += "vertex " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid tetrahedron\n";
}

Scene load_bytes(const std::string& content) {
  const TemporaryFile file("model.STL", content);
  return load_scene(file.path().string());
}

std::string error_of(const std::string& content) {
  return input_error_of([&] { (void)load_bytes(content); });
}

TEST(Stl, ReadsTextAndBinaryAlikeAndJoinsVertices) {
  for (const std::string& content : {text_tetrahedron(), binary_tetrahedron(), binary_tetrahedron("solid in spite of all")}) {
    const Scene scene = load_bytes(content);
    ASSERT_EQ(scene.primitive_count(), 4U);
    const TriangleMesh& mesh = *std::get<std::shared_ptr<TriangleMesh>>(scene.objects[0].geometry);
    ASSERT_EQ(mesh.vertices().size(), 4U);
    for (std::size_t face = 0; face < 4; ++face) {
      for (int corner = 0; corner < 3; ++corner) {
        EXPECT_EQ(mesh.vertices()[mesh.triangles()[face][corner]], kTetrahedron[kFaces[face][corner]]);
      }
    }
    EXPECT_TRUE(scene.warnings.empty());
  }
}

TEST(Stl, RefusesWhatIsCutShort) {
  EXPECT_THAT(error_of(""), HasSubstr("the file is empty"));
  const std::string binary = binary_tetrahedron();
  EXPECT_THAT(error_of(binary.substr(0, 60)), HasSubstr("too short"));
  EXPECT_THAT(error_of(binary.substr(0, binary.size() - 1)), HasSubstr("announces 4 triangles, which take 284 bytes, but it has 283"));
  EXPECT_THAT(error_of(binary + "x"), HasSubstr("but it has 285"));
  EXPECT_THAT(error_of(binary_tetrahedron("solid").substr(0, 200)), HasSubstr("cut short"));
  const std::string text = text_tetrahedron();
  EXPECT_THAT(error_of(text.substr(0, text.size() / 2)), HasSubstr("cut short"));
  EXPECT_THAT(error_of("solid nothing\nendsolid nothing\n"), HasSubstr("nothing renderable"));
}

TEST(Stl, RefusesACountThatTheFileCannotHold) {
  std::string binary = binary_tetrahedron();
  binary.replace(80, 4, "\xff\xff\xff\xff");
  EXPECT_THAT(error_of(binary), HasSubstr("announces 4294967295 triangles"));
}

TEST(Stl, KeepsOutTrianglesThatCanNeverBeHit) {
  std::string binary = binary_tetrahedron();
  std::string nan;
  append_u32(nan, std::bit_cast<std::uint32_t>(std::numeric_limits<float>::quiet_NaN()));
  binary.replace(84 + 12, 4, nan);
  const Scene scene = load_bytes(binary);
  EXPECT_EQ(scene.primitive_count(), 3U);
  EXPECT_THAT(scene.warnings, testing::ElementsAre(HasSubstr("1 triangle was left out")));
}

TEST(Stl, SurvivesMutations) {
  const TemporaryFile file("mutant.stl", "");
  int read = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::string base = seed % 2 == 0 ? text_tetrahedron() : binary_tetrahedron();
    try {
      file.rewrite(mutated(base, seed));
      ASSERT_GT(load_scene(file.path().string()).primitive_count(), 0U);
      ++read;
    } catch (const InputError& error) {
      ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
  EXPECT_GT(read, 20);
}

}  // namespace
}  // namespace grove
