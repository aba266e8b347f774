#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "grove/base/error.h"
#include "grove/base/random.h"
#include "grove/scene/load.h"
#include "scene/gltf_file.h"

namespace grove {
namespace {

using ::testing::HasSubstr;

constexpr std::uint32_t kGrid = 12;

/// A bumpy grid, compressed by Draco, as a glTF file.
class GltfDraco : public ::testing::Test {
 protected:
  GltfDraco()
      : file_path_(std::filesystem::path(::testing::TempDir()) /
                   (std::string("grove_draco_") + ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".glb")) {}
  ~GltfDraco() override { std::filesystem::remove(file_path_); }

  static Vec3 point(std::uint32_t x, std::uint32_t y) {
    return {static_cast<float>(x), static_cast<float>(y), static_cast<float>((x * 7 + y * 3) % 5)};
  }

  void make(int speed) {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(2 * kGrid * kGrid);
    const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int uv = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
    std::uint32_t face = 0;
    const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
      const draco::FaceIndex id(face++);
      builder.SetAttributeValuesForFace(position, id, &a, &b, &c);
      const Vec2 ua(a / float(kGrid));
      const Vec2 ub(b / float(kGrid));
      const Vec2 uc(c / float(kGrid));
      builder.SetAttributeValuesForFace(uv, id, &ua, &ub, &uc);
    };
    for (std::uint32_t y = 0; y < kGrid; ++y) {
      for (std::uint32_t x = 0; x < kGrid; ++x) {
        add(point(x, y), point(x + 1, y), point(x, y + 1));
        add(point(x + 1, y), point(x + 1, y + 1), point(x, y + 1));
      }
    }
    const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
    draco::Encoder encoder;
    encoder.SetSpeedOptions(speed, speed);
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 16);
    encoder.SetAttributeQuantization(draco::GeometryAttribute::TEX_COORD, 12);
    draco::EncoderBuffer buffer;
    ASSERT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());

    view_ = file_.add_view(std::vector<char>(buffer.data(), buffer.data() + buffer.size()));
    file_.json["accessors"] = {{{"componentType", 5125}, {"count", 6 * kGrid * kGrid}, {"type", "SCALAR"}},
                               {{"componentType", 5126}, {"count", mesh->num_points()}, {"type", "VEC3"}},
                               {{"componentType", 5126}, {"count", mesh->num_points()}, {"type", "VEC2"}}};
    const auto unique_id = [&](int attribute) { return mesh->attribute(attribute)->unique_id(); };
    const nlohmann::json attributes = {{"POSITION", unique_id(position)}, {"TEXCOORD_0", unique_id(uv)}};
    file_.add_node({{"mesh", file_.add_mesh({{"attributes", {{"POSITION", 1}, {"TEXCOORD_0", 2}}},
                                             {"indices", 0},
                                             {"extensions",
                                              {{"KHR_draco_mesh_compression", {{"bufferView", view_}, {"attributes", attributes}}}}}})}});
    file_.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  }

  Scene load() const {
    std::ofstream(file_path_, std::ios::binary) << file_.glb();
    return load_gltf(file_path_);
  }

  GltfFile file_;
  int view_ = 0;
  std::filesystem::path file_path_;
};

// Fast speeds use Draco's sequential coding, slow ones Edgebreaker.
TEST_F(GltfDraco, CompressedMeshesComeOutWhole) {
  for (const int speed : {0, 5, 10}) {
    file_ = {};
    make(speed);
    const Scene scene = load();
    EXPECT_EQ(scene.primitive_count(), 2U * kGrid * kGrid) << "speed " << speed;
    const Box bounds = scene.bounds();
    EXPECT_LT(glm::distance(bounds.lower, Vec3(0.0F)), 1e-3F);
    EXPECT_LT(glm::distance(bounds.upper, Vec3(kGrid, kGrid, 4)), 1e-3F);
    const auto& mesh = *std::get<std::shared_ptr<TriangleMesh>>(scene.objects[0].geometry);
    const Part& part = scene.objects[0].parts[0];
    ASSERT_EQ(part.uvs.size(), mesh.vertices().size());
    for (std::size_t i = 0; i < part.uvs.size(); ++i) {
      EXPECT_LT(glm::distance(part.uvs[i] * float(kGrid), Vec2(mesh.vertices()[i])), 1e-2F);
    }
  }
}

TEST_F(GltfDraco, AClaimOfTooManyTrianglesIsAnError) {
  make(10);
  // After the magic word, two version bytes, type, method and flags: a count of triangles in seven bits a byte.
  const std::size_t offset = file_.json["bufferViews"][static_cast<std::size_t>(view_)]["byteOffset"].get<std::size_t>() + 11;
  for (std::size_t i = 0; i < 4; ++i) file_.binary[offset + i] = static_cast<char>(0xff);
  file_.binary[offset + 4] = 0x07;
  try {
    (void)load();
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("claims"));
  }
}

// A scene or an InputError, whatever the damage; run under the address sanitiser this finds reads outside the buffers.
TEST_F(GltfDraco, DamagedDataGivesASceneOrAnError) {
  constexpr std::uint64_t kSeed = 4;
  Random random(kSeed);
  for (const int speed : {0, 10}) {
    file_ = {};
    make(speed);
    const std::string whole = file_.binary;
    for (int variant = 0; variant < fuzz_variants(100); ++variant) {
      file_.binary = whole;
      for (int flip = 0; flip < 3; ++flip) {
        file_.binary[random.next_u32(static_cast<std::uint32_t>(whole.size()))] = static_cast<char>(random.next_u32(256));
      }
      try {
        EXPECT_GT(load().primitive_count(), 0U);
      } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr(".glb")) << "seed " << kSeed << ", variant " << variant;
      }
    }
  }
}

}  // namespace
}  // namespace grove
