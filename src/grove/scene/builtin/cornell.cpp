// The box with one red and one green wall in which global illumination was first compared with a photograph (Goral, Torrance, Greenberg,
// Battaile 1984, "Modeling the Interaction of Light Between Diffuse Surfaces"), here with straight walls, 2 units wide.

#include <cmath>

#include "grove/scene/builtin/generators.h"
#include "grove/scene/builtin/scene_builder.h"
#include "grove/scene/builtin/shapes.h"

namespace grove {
namespace {

constexpr std::uint64_t kMaxCells = 2000;

// A box without bottom, standing on y = -1 and turned about the vertical.
PartMesh make_block(const Vec2& centre, float width, float height, double turns, std::uint32_t cells) {
  const Vec2 c = unit_circle(turns);
  const Vec3 x(width * c.x, 0.0F, width * c.y);
  const Vec3 z(-width * c.y, 0.0F, width * c.x);
  const Vec3 y(0.0F, height, 0.0F);
  const Vec3 corner = Vec3(centre.x, -1.0F, centre.y) - 0.5F * (x + z);
  PartMesh block;
  add_grid(block, corner + y, z, x, cells);
  add_grid(block, corner + z, x, y, cells);
  add_grid(block, corner + x + z, -z, y, cells);
  add_grid(block, corner + x, -x, y, cells);
  add_grid(block, corner, z, y, cells);
  return block;
}

PartMesh make_grid(const Vec3& corner, const Vec3& u, const Vec3& v, std::uint32_t cells) {
  PartMesh mesh;
  add_grid(mesh, corner, u, v, cells);
  return mesh;
}

}  // namespace

Scene make_cornell(const BuiltinOptions& options) {
  options.allow_only({"size", "triangles", "primitives", "objects"});
  const bool blocks = options.choice("objects", {"blocks", "spheres"}) == "blocks";
  const auto count = [&](std::uint64_t cells) { return cells * cells * (blocks ? 32 : 12) + (blocks ? 0 : 2); };
  std::uint64_t size = options.integer("size", 1, 1, kMaxCells);
  if (const std::uint64_t target = options.target(); target > 0) size = nearest_size(target, 1, kMaxCells, count);
  const auto cells = static_cast<std::uint32_t>(size);

  SceneBuilder builder;
  const std::uint32_t white = builder.add_material(matte({0.73F, 0.71F, 0.68F}));
  const std::uint32_t red = builder.add_material(matte({0.63F, 0.065F, 0.05F}));
  const std::uint32_t green = builder.add_material(matte({0.14F, 0.45F, 0.091F}));
  const std::uint32_t light = builder.add_material(lamp({17.0F, 12.0F, 6.0F}));

  const Vec3 x(2.0F, 0.0F, 0.0F);
  const Vec3 y(0.0F, 2.0F, 0.0F);
  const Vec3 z(0.0F, 0.0F, 2.0F);
  builder.add_mesh("floor", make_grid({-1, -1, -1}, z, x, cells), white);
  builder.add_mesh("ceiling", make_grid({-1, 1, -1}, x, z, cells), white);
  builder.add_mesh("back wall", make_grid({-1, -1, -1}, x, y, cells), white);
  builder.add_mesh("left wall", make_grid({-1, -1, -1}, y, z, cells), red);
  builder.add_mesh("right wall", make_grid({1, -1, -1}, z, y, cells), green);
  // Just below the ceiling, facing down.
  builder.add_mesh("lamp", make_grid({-0.24F, 0.998F, -0.22F}, 0.24F * x, 0.2F * z, cells), light);
  if (blocks) {
    builder.add_mesh("tall block", make_block({-0.33F, -0.3F}, 0.6F, 1.2F, -0.047, cells), white);
    builder.add_mesh("short block", make_block({0.34F, 0.36F}, 0.6F, 0.6F, 0.046, cells), white);
  } else {
    builder.add_spheres("mirror sphere", {{.centre = {-0.42F, -0.6F, -0.32F}, .radius = 0.4F}},
                        builder.add_material(metal({0.95F, 0.93F, 0.88F}, 0.08F)));
    builder.add_spheres("glass sphere", {{.centre = {0.42F, -0.6F, 0.28F}, .radius = 0.4F}}, builder.add_material(glass()));
  }
  return builder.finish(look_at({0.0F, 0.0F, 3.9F}, {0.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}, 0.665F), {.width = 600, .height = 600});
}

}  // namespace grove
