// A yard at night between blocks of stone, lit by nothing but lanterns: as many as wanted, of the same light in all, so that pictures of one
// lantern and of ten thousand are about equally bright. Made to measure how lights are chosen.

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "grove/base/random.h"
#include "grove/scene/builtin/generators.h"
#include "grove/scene/builtin/scene_builder.h"
#include "grove/scene/builtin/shapes.h"

namespace grove {
namespace {

constexpr std::uint64_t kMaxSize = 2000;
constexpr std::uint64_t kMaxLights = 1'000'000;
constexpr float kHalfYard = 10.0F;
constexpr float kTotalIntensity = 220.0F;  // of all lanterns together, in any one direction
constexpr Vec3 kColours[] = {{1.0F, 0.62F, 0.28F}, {1.0F, 0.85F, 0.6F}, {0.55F, 0.75F, 1.0F}, {1.0F, 0.4F, 0.3F}};
constexpr std::uint32_t kColourCount = std::size(kColours);

// A box without bottom on the ground.
void add_block(PartMesh& mesh, const Vec3& centre, float width, float height) {
  const Vec3 x(width, 0.0F, 0.0F);
  const Vec3 y(0.0F, height, 0.0F);
  const Vec3 z(0.0F, 0.0F, width);
  const Vec3 corner = centre - 0.5F * (x + z);
  add_grid(mesh, corner + y, z, x, 1);
  add_grid(mesh, corner + z, x, y, 1);
  add_grid(mesh, corner + x, y, z, 1);
  add_grid(mesh, corner, y, x, 1);
  add_grid(mesh, corner + x + z, -z, y, 1);
}

// Eight faces of which each shines outwards.
void add_octahedron(PartMesh& mesh, const Vec3& centre, float radius) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 offset(0.0F);
    offset[axis] = radius;
    mesh.vertices.push_back(centre + offset);
    mesh.vertices.push_back(centre - offset);
  }
  for (std::uint32_t face = 0; face < 8; ++face) {
    const std::uint32_t x = face & 1;
    const std::uint32_t y = face >> 1 & 1;
    const std::uint32_t z = face >> 2;
    Triangle triangle(first + x, first + 2 + y, first + 4 + z);
    // An odd number of mirrorings turns the winding.
    if (((x + y + z) & 1) != 0) std::swap(triangle.y, triangle.z);
    mesh.triangles.push_back(triangle);
  }
}

Vec3 lantern_place(Random& random, std::uint64_t count) {
  if (count == 1) return {1.0F, 3.0F, 0.5F};
  // Strings of lanterns hang at heights between knee and roof.
  const float x = random.next_float(-kHalfYard, kHalfYard);
  const float z = random.next_float(-kHalfYard, kHalfYard);
  return {x, random.next_float(0.4F, 3.2F), z};
}

}  // namespace

Scene make_lanterns(const BuiltinOptions& options) {
  options.allow_only({"size", "triangles", "primitives", "seed", "lights", "kind"});
  const std::string_view kind = options.choice("kind", {"mesh", "points", "spots"});
  const std::uint64_t lights = options.integer("lights", 1000, 1, kMaxLights);
  const std::uint64_t lamp_triangles = kind == "mesh" ? 8 * lights : 0;
  const auto count = [&](std::uint64_t n) { return 10 * n * n + 2 + lamp_triangles; };
  std::uint64_t size = options.integer("size", 9, 1, kMaxSize);
  if (const std::uint64_t target = options.target(); target > 0) size = nearest_size(target, 1, kMaxSize, count);

  SceneBuilder builder;
  PartMesh ground;
  add_ground(ground, {0.0F, 0.0F, 0.0F}, 3.0F * kHalfYard);
  builder.add_mesh("ground", std::move(ground), builder.add_material(matte({0.5F, 0.48F, 0.45F})));
  Random random(options.seed());
  PartMesh blocks;
  const float spacing = 2.0F * kHalfYard / static_cast<float>(size);
  for (std::uint64_t j = 0; j < size; ++j) {
    for (std::uint64_t i = 0; i < size; ++i) {
      const Vec3 centre(spacing * (static_cast<float>(i) + 0.5F) - kHalfYard, 0.0F, spacing * (static_cast<float>(j) + 0.5F) - kHalfYard);
      add_block(blocks, centre, 0.5F * spacing, random.next_float(0.3F, 1.2F) * std::min(spacing, 2.0F));
    }
  }
  builder.add_mesh("blocks", std::move(blocks), builder.add_material(plastic({0.6F, 0.6F, 0.62F}, 0.45F)));

  const float intensity = kTotalIntensity / static_cast<float>(lights);
  const float radius = 0.12F * std::min(1.0F, std::cbrt(100.0F / static_cast<float>(lights)));
  PartMesh lamps[kColourCount];
  for (std::uint64_t i = 0; i < lights; ++i) {
    const Vec3 place = lantern_place(random, lights);
    const auto colour = static_cast<std::uint32_t>(i % kColourCount);
    if (kind == "mesh") {
      add_octahedron(lamps[colour], place, radius);
      continue;
    }
    PunctualLight light;
    light.name = "lantern " + std::to_string(i);
    light.position = place;
    light.intensity = intensity * kColours[colour];
    if (kind == "spots") {
      light.kind = PunctualLightKind::spot;
      const Vec2 around = unit_circle(static_cast<double>(random.next_float()));
      light.direction = glm::normalize(Vec3(0.6F * around.x, -1.0F, 0.6F * around.y));
      light.inner_angle = 0.4F;
      light.outer_angle = 0.7F;
      // What a lamp throws backwards is thrown forwards.
      light.intensity *= 4.0F;
    }
    builder.add_light(std::move(light));
  }
  // From afar an octahedron shows about half of its faces, each at a slant: a quarter of its area, 4 sqrt(3) r^2.
  const float radiance = intensity / (std::sqrt(3.0F) * radius * radius);
  for (std::uint32_t c = 0; c < kColourCount; ++c) {
    if (lamps[c].triangles.empty()) continue;
    builder.add_mesh("lanterns " + std::to_string(c), std::move(lamps[c]), builder.add_material(lamp(radiance * kColours[c])));
  }
  return builder.finish(look_at({-8.5F, 6.2F, 12.5F}, {0.0F, 0.4F, 0.0F}, {0.0F, 1.0F, 0.0F}, 0.75F));
}

}  // namespace grove
