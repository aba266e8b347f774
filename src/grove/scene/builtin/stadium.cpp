// A teapot in a stadium: a small dense object (a torus knot) in a huge sparse hall. Structures that cut space evenly spend all their cells on
// the hall; those that follow the geometry do not.

#include <cmath>
#include <utility>
#include <vector>

#include "grove/scene/builtin/generators.h"
#include "grove/scene/builtin/scene_builder.h"
#include "grove/scene/builtin/shapes.h"

namespace grove {
namespace {

constexpr std::uint64_t kMaxSides = 3000;
constexpr std::uint32_t kRingsPerSide = 8;
constexpr std::uint32_t kSteps = 14;  // of the stands
constexpr std::uint32_t kLamps = 5;   // along each axis
constexpr float kHalfLength = 60.0F;  // metres
constexpr float kHeight = 30.0F;

// Floor, ceiling and four walls, steps of two quads on four sides, lamps, and the pedestal of five.
constexpr std::uint64_t kHallTriangles = 2 * (6 + 2 * 4 * kSteps + kLamps * kLamps + 5);

std::uint64_t triangle_count(std::uint64_t sides) {
  return kHallTriangles + 2 * kRingsPerSide * sides * sides;
}

// The (2, 3) torus knot, about 0.5 across.
PartMesh make_knot(std::uint32_t sides) {
  const std::uint32_t rings = kRingsPerSide * sides;
  std::vector<Vec3> line(rings);
  for (std::uint32_t i = 0; i < rings; ++i) {
    const double t = static_cast<double>(i) / rings;
    const Vec2 around = unit_circle(2.0 * t);
    const Vec2 through = unit_circle(3.0 * t);
    const float radius = 0.16F + 0.07F * through.x;
    line[i] = Vec3(radius * around.x, 1.32F + radius * around.y, 0.08F * through.y);
  }
  const std::vector<float> radii(rings, 0.036F);
  PartMesh mesh;
  add_tube(mesh, {.centres = line, .radii = radii, .sides = sides, .closed = true});
  return mesh;
}

// Four sides of a frame around the pitch, each step one unit further out and half a unit higher.
void add_stands(PartMesh& mesh) {
  for (std::uint32_t step = 0; step < kSteps; ++step) {
    const float inner = 30.0F + 1.2F * static_cast<float>(step);
    const float height = 0.7F * static_cast<float>(step);
    for (int side = 0; side < 4; ++side) {
      const Vec2 c = side == 0 ? Vec2(1, 0) : side == 1 ? Vec2(0, 1) : side == 2 ? Vec2(-1, 0) : Vec2(0, -1);
      const Vec3 out(c.x, 0.0F, c.y);
      const Vec3 along(c.y, 0.0F, -c.x);
      const Vec3 corner = inner * out - (inner + 1.2F) * along + Vec3(0.0F, height, 0.0F);
      const Vec3 length = 2.0F * (inner + 1.2F) * along;
      add_grid(mesh, corner, length, Vec3(0.0F, 0.7F, 0.0F), 1);
      add_grid(mesh, corner + Vec3(0.0F, 0.7F, 0.0F), length, 1.2F * out, 1);
    }
  }
}

void add_hall(PartMesh& mesh) {
  const Vec3 x(2.0F * kHalfLength, 0.0F, 0.0F);
  const Vec3 y(0.0F, kHeight, 0.0F);
  const Vec3 z(0.0F, 0.0F, 2.0F * kHalfLength);
  const Vec3 corner(-kHalfLength, 0.0F, -kHalfLength);
  add_grid(mesh, corner + y, x, z, 1);
  add_grid(mesh, corner, x, y, 1);
  add_grid(mesh, corner + z, y, x, 1);
  add_grid(mesh, corner, y, z, 1);
  add_grid(mesh, corner + x, z, y, 1);
}

void add_pedestal(PartMesh& mesh) {
  constexpr float half = 0.22F;
  constexpr float top = 1.03F;
  const Vec3 x(2.0F * half, 0.0F, 0.0F);
  const Vec3 y(0.0F, top, 0.0F);
  const Vec3 z(0.0F, 0.0F, 2.0F * half);
  const Vec3 corner(-half, 0.0F, -half);
  add_grid(mesh, corner + y, z, x, 1);
  add_grid(mesh, corner, y, x, 1);
  add_grid(mesh, corner + z, x, y, 1);
  add_grid(mesh, corner, z, y, 1);
  add_grid(mesh, corner + x, y, z, 1);
}

void add_lamps(PartMesh& mesh) {
  for (std::uint32_t j = 0; j < kLamps; ++j) {
    for (std::uint32_t i = 0; i < kLamps; ++i) {
      const Vec3 centre(16.0F * (static_cast<float>(i) - 2.0F), kHeight - 0.5F, 16.0F * (static_cast<float>(j) - 2.0F));
      add_grid(mesh, centre - Vec3(3.0F, 0.0F, 3.0F), {6.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 6.0F}, 1);
    }
  }
}

}  // namespace

Scene make_stadium(const BuiltinOptions& options) {
  options.allow_only({"size", "triangles", "primitives"});
  std::uint64_t sides = options.integer("size", 80, 3, kMaxSides);
  if (const std::uint64_t target = options.target(); target > 0) sides = nearest_size(target, 3, kMaxSides, triangle_count);

  SceneBuilder builder;
  Material pitch = plastic(Vec3(1.0F), 0.5F);
  pitch.base_colour.texture = builder.add_checkerboard({0.1F, 0.22F, 0.07F}, {0.14F, 0.29F, 0.1F}, 60.0F);
  PartMesh ground;
  add_ground(ground, {0.0F, 0.0F, 0.0F}, kHalfLength);
  builder.add_mesh("pitch", std::move(ground), builder.add_material(std::move(pitch)));
  PartMesh hall;
  add_hall(hall);
  builder.add_mesh("hall", std::move(hall), builder.add_material(matte({0.55F, 0.56F, 0.58F})));
  PartMesh stands;
  add_stands(stands);
  builder.add_mesh("stands", std::move(stands), builder.add_material(matte({0.3F, 0.22F, 0.42F})));
  PartMesh lamps;
  add_lamps(lamps);
  builder.add_mesh("lamps", std::move(lamps), builder.add_material(lamp({17.0F, 16.0F, 14.0F})));
  PartMesh pedestal;
  add_pedestal(pedestal);
  builder.add_mesh("pedestal", std::move(pedestal), builder.add_material(plastic({0.75F, 0.74F, 0.72F}, 0.3F)));
  builder.add_mesh("knot", make_knot(static_cast<std::uint32_t>(sides)), builder.add_material(metal({1.0F, 0.72F, 0.32F}, 0.22F)));
  return builder.finish(look_at({0.55F, 1.62F, 1.5F}, {0.0F, 1.27F, 0.0F}, {0.0F, 1.0F, 0.0F}, 0.62F));
}

}  // namespace grove
