#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "grove/base/error.h"
#include "grove/scene/load.h"
#include "scene/gltf_file.h"

namespace grove {

/// A glTF file in the making, in a folder of the test's own, and what loading it gives.
class Gltf : public ::testing::Test {
 protected:
  Gltf()
      : folder_(std::filesystem::path(::testing::TempDir()) /
                (std::string("grove_gltf_") + ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::create_directories(folder_);
  }
  ~Gltf() override { std::filesystem::remove_all(folder_); }

  Scene load() const {
    std::ofstream(folder_ / "scene.glb", std::ios::binary) << file_.glb();
    return load_gltf(folder_ / "scene.glb");
  }

  std::string error() const {
    try {
      (void)load();
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }

  static const TriangleMesh& mesh(const Scene& scene, std::size_t object = 0) {
    return *std::get<std::shared_ptr<TriangleMesh>>(scene.objects[object].geometry);
  }

  static std::vector<Vec3> vertices(const Scene& scene, std::size_t object = 0) {
    const auto span = mesh(scene, object).vertices();
    return {span.begin(), span.end()};
  }

  static std::vector<Triangle> triangles(const Scene& scene, std::size_t object = 0) {
    const auto span = mesh(scene, object).triangles();
    return {span.begin(), span.end()};
  }

  /// Shows a triangle with the given material.
  Material load_material(const GltfFile::Json& material) {
    const int id = file_.add_triangle();
    file_.json["meshes"][static_cast<std::size_t>(id)]["primitives"][0]["material"] = 0;
    file_.add_node({{"mesh", id}});
    file_.json["materials"] = {material};
    scene_ = load();
    return scene_.materials.at(0);
  }

  GltfFile file_;
  Scene scene_;
  std::filesystem::path folder_;
};

}  // namespace grove
