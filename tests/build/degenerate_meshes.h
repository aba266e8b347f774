#pragma once

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "build/sample_meshes.h"

namespace grove::testing {

struct NamedMesh {
  std::string name;
  TriangleMesh mesh;
};

/// Sets that give a plane nothing to go by.
inline std::vector<NamedMesh> degenerate_meshes() {
  constexpr std::uint32_t kCount = 20000;
  const auto make = [](const auto& vertex_of) {
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 0; i < kCount; ++i) {
      for (int corner = 0; corner < 3; ++corner) vertices.push_back(vertex_of(i, corner));
      triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    return TriangleMesh(std::move(vertices), std::move(triangles));
  };
  const Vec3 corners[] = {{0, 0, 0}, {1, 0, 1}, {0, 1, 1}};
  const float nan = std::numeric_limits<float>::quiet_NaN();
  Random random(6);
  std::vector<NamedMesh> meshes;
  meshes.push_back({"in one plane", make([&](std::uint32_t i, int corner) {
                      const Vec3 p = corners[corner];
                      return Vec3(p.x + static_cast<float>(i % 100), p.y + static_cast<float>(i / 100), 3.0F);
                    })});
  meshes.push_back({"axis-aligned duplicates", make([&](std::uint32_t i, int corner) {
                      return Vec3(static_cast<float>(i % 5), corners[corner].x, corners[corner].y);
                    })});
  meshes.push_back({"identical", make([&](std::uint32_t /*i*/, int corner) { return corners[corner]; })});
  meshes.push_back({"not finite", make([&](std::uint32_t i, int corner) {
                      const Vec3 p = 0.01F * corners[corner] + random_point(random);
                      return i % 3 == 0 && corner == 1 ? Vec3(p.x, nan, p.z) : p;
                    })});
  meshes.push_back({"all overlap every cell", make([&](std::uint32_t i, int corner) {
                      return 100.0F * corners[corner] + 1e-3F * static_cast<float>(i % 7) * random_point(random);
                    })});
  meshes.push_back({"points", make([](std::uint32_t i, int /*corner*/) { return Vec3(static_cast<float>(i % 7)); })});
  meshes.push_back({"on a line", make([](std::uint32_t i, int corner) { return Vec3(static_cast<float>(i + corner), 0.0F, 0.0F); })});
  return meshes;
}

}  // namespace grove::testing
