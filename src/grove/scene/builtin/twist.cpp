// Upright ribbons on a square floor, twisted about the middle as time goes from 0 to 1: each point moves along, its neighbours with it. A hierarchy
// that is only refitted gets worse slowly.

#include <cmath>
#include <string>

#include "grove/base/parallel.h"
#include "grove/base/random.h"
#include "grove/scene/builtin/generators.h"
#include "grove/scene/builtin/scene_builder.h"
#include "grove/scene/builtin/shapes.h"

namespace grove {
namespace {

constexpr std::uint64_t kSegments = 64;
constexpr double kTurns = 1.5;

std::uint64_t triangle_count(std::uint64_t ribbons) {
  return 2 * kSegments * ribbons * ribbons;
}

PartMesh make_ribbons(std::uint64_t ribbons, std::uint64_t seed, double time) {
  PartMesh mesh;
  mesh.vertices.resize(2 * (kSegments + 1) * ribbons * ribbons);
  mesh.triangles.resize(triangle_count(ribbons));
  const auto spacing = 2.0F / static_cast<float>(ribbons);
  parallel_for(ribbons * ribbons, 64, [&](std::size_t ribbon) {
    Random random(mix_bits(seed) ^ ribbon);
    const auto place = [&](std::uint64_t i) { return (static_cast<float>(i) + random.next_float(0.2F, 0.8F)) * spacing - 1.0F; };
    const float x = place(ribbon % ribbons);
    const float z = place(ribbon / ribbons);
    const Vec2 facing = 0.3F * spacing * unit_circle(static_cast<double>(random.next_float()));
    const float height = random.next_float(1.5F, 2.5F);
    const std::size_t first_vertex = 2 * (kSegments + 1) * ribbon;
    for (std::size_t k = 0; k <= kSegments; ++k) {
      const float y = height * static_cast<float>(k) / static_cast<float>(kSegments);
      const Vec2 turn = unit_circle(kTurns * time * static_cast<double>(y) / 2.0);
      const float width = 1.0F - static_cast<float>(k) / static_cast<float>(kSegments + 1);
      for (std::size_t side = 0; side < 2; ++side) {
        const Vec2 offset = (side == 0 ? -width : width) * facing;
        const Vec2 at(x + offset.x, z + offset.y);
        mesh.vertices[first_vertex + 2 * k + side] = {turn.x * at.x - turn.y * at.y, y, turn.y * at.x + turn.x * at.y};
      }
    }
    for (std::size_t k = 0; k < kSegments; ++k) {
      const auto v = static_cast<std::uint32_t>(first_vertex + 2 * k);
      mesh.triangles[2 * (kSegments * ribbon + k)] = {v, v + 1, v + 3};
      mesh.triangles[2 * (kSegments * ribbon + k) + 1] = {v, v + 3, v + 2};
    }
  });
  return mesh;
}

}  // namespace

Scene make_twist(const BuiltinOptions& options) {
  options.allow_only({"size", "triangles", "primitives", "seed", "time"});
  std::uint64_t ribbons = options.integer("size", 20, 1, 1000);
  if (const std::uint64_t target = options.target(); target > 0) ribbons = nearest_size(target, 1, 1000, triangle_count);
  SceneBuilder builder;
  builder.add_mesh("ribbons", make_ribbons(ribbons, options.seed(), options.number("time", 0.0, 0.0, 1.0)),
                   builder.add_material(plastic({0.1F, 0.42F, 0.36F}, 0.35F)));
  PartMesh floor;
  add_ground(floor, {0.0F, 0.0F, 0.0F}, 3.0F);
  builder.add_mesh("floor", std::move(floor), builder.add_material(matte({0.6F, 0.57F, 0.52F})));
  builder.set_sky({0.35F, 0.5F, 0.8F}, {0.8F, 0.85F, 0.9F}, {0.3F, 0.28F, 0.25F});
  builder.add_sun({-0.5F, -0.8F, -0.4F}, {2.6F, 2.4F, 2.1F});
  return builder.finish(look_at({3.6F, 2.6F, 4.6F}, {0.0F, 1.0F, 0.0F}, {0.0F, 1.0F, 0.0F}, 0.7F));
}

}  // namespace grove
