#pragma once

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "grove/base/random.h"
#include "grove/scene/scene.h"

namespace grove::testing {

/// A closed box of 12 triangles around 200 small random ones: every ray from inside hits something.
inline Scene small_scene() {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  vertices.reserve(std::size_t{8} + 3 * 200);
  for (int corner = 0; corner < 8; ++corner) vertices.emplace_back(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
  for (const auto& [a, b, c, d] :
       {std::array{0U, 2U, 3U, 1U}, {4U, 5U, 7U, 6U}, {0U, 1U, 5U, 4U}, {2U, 6U, 7U, 3U}, {0U, 4U, 6U, 2U}, {1U, 3U, 7U, 5U}}) {
    triangles.emplace_back(a, b, c);
    triangles.emplace_back(a, c, d);
  }
  Random random(5);
  const auto point = [&] {
    const float x = random.next_float();
    const float y = random.next_float();
    return Vec3(x, y, random.next_float());
  };
  for (int i = 0; i < 200; ++i) {
    const Vec3 centre = 0.1F + 0.8F * point();
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (int k = 0; k < 3; ++k) vertices.push_back(centre + 0.1F * (point() - 0.5F));
    triangles.emplace_back(first, first + 1, first + 2);
  }
  Scene scene;
  scene.name = "small";
  scene.materials.resize(1);
  scene.objects.push_back({"all", std::make_shared<TriangleMesh>(std::move(vertices), std::move(triangles)), {Part{}}});
  scene.instances.push_back({"all", 0, Transform()});
  return scene;
}

/// The same object twice, side by side: a scene with a top level.
inline Scene instanced_scene() {
  Scene scene = small_scene();
  Mat4 moved(1.0F);
  moved[3] = Vec4(1.5F, 0.25F, 0.0F, 1.0F);
  scene.instances.push_back({"moved", 0, Transform(moved)});
  return scene;
}

}  // namespace grove::testing
