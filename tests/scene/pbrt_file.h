#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "grove/base/error.h"
#include "grove/scene/load.h"

namespace grove {

/// A directory of its own for each test, with pbrt files in it; gone afterwards.
class PbrtTest : public testing::Test {
 protected:
  PbrtTest() {
    static int count = 0;
    directory_ = std::filesystem::temp_directory_path() / ("grove-pbrt-" + std::to_string(getpid()) + "-" + std::to_string(count++));
    std::filesystem::create_directories(directory_);
  }
  ~PbrtTest() override {
    std::error_code error;
    std::filesystem::remove_all(directory_, error);
  }

  std::filesystem::path write(const std::string& name, std::string_view text) const {
    const std::filesystem::path file = directory_ / name;
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }

  Scene load(std::string_view text) const { return load_pbrt(write("scene.pbrt", text)); }

  /// The world part of a scene that has one triangle of its own, so that it is never empty.
  Scene load_world(std::string_view world) const { return load("WorldBegin\n" + std::string(world) + "\n" + std::string(kTriangle)); }

  /// What the error of a scene says after its directory; "" when there is none.
  std::string error_of(std::string_view text) const {
    try {
      load(text);
    } catch (const InputError& error) {
      std::string message = error.what();
      const std::string prefix = directory_.string() + "/";
      for (std::size_t at = message.find(prefix); at != std::string::npos; at = message.find(prefix)) message.erase(at, prefix.size());
      return message;
    }
    return "";
  }

  static const TriangleMesh& mesh(const Scene& scene, std::size_t object = 0) {
    return *std::get<std::shared_ptr<TriangleMesh>>(scene.objects.at(object).geometry);
  }
  static const SphereSet& spheres(const Scene& scene, std::size_t object = 0) {
    return *std::get<std::shared_ptr<SphereSet>>(scene.objects.at(object).geometry);
  }
  /// The material of a part of the first object.
  static const Material& material(const Scene& scene, std::size_t part = 0) {
    return scene.materials.at(scene.objects.at(0).parts.at(part).material);
  }
  static bool warns_of(const Scene& scene, std::string_view text) {
    for (const std::string& warning : scene.warnings) {
      if (warning.find(text) != std::string::npos) return true;
    }
    return false;
  }

  static constexpr std::string_view kTriangle = "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0  1 0 0  0 1 0 ]\n";

  std::filesystem::path directory_;
};

inline void expect_near(const Vec3& actual, const Vec3& expected, float tolerance = 1e-5F) {
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(actual[axis], expected[axis], tolerance) << "axis " << axis;
}

}  // namespace grove
