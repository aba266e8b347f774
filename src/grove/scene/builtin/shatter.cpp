// A ball whose triangles fly apart as time goes from 0 to 1, each in a direction of its own and spinning: what lay side by side does not stay
// so, which a refit cannot mend.

#include <cmath>
#include <string>

#include "grove/base/parallel.h"
#include "grove/base/random.h"
#include "grove/scene/builtin/generators.h"
#include "grove/scene/builtin/scene_builder.h"
#include "grove/scene/builtin/shapes.h"

namespace grove {
namespace {

constexpr std::uint64_t kMostCells = 2000;

Vec3 random_vector(Random& random) {
  Vec3 v;
  for (int axis = 0; axis < 3; ++axis) v[axis] = random.next_float(-1.0F, 1.0F);
  return v;
}

std::uint64_t triangle_count(std::uint64_t cells) {
  return 12 * cells * cells;
}

// A cube of cells * cells squares a face, blown up to the unit sphere.
PartMesh make_ball(std::uint32_t cells) {
  PartMesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0F, 1.0F}) {
      Vec3 corner(-1.0F);
      corner[axis] = side;
      Vec3 u(0.0F);
      Vec3 v(0.0F);
      u[(axis + (side > 0.0F ? 1 : 2)) % 3] = 2.0F;
      v[(axis + (side > 0.0F ? 2 : 1)) % 3] = 2.0F;
      add_grid(mesh, corner, u, v, cells);
    }
  }
  for (Vec3& v : mesh.vertices) v = glm::normalize(v);
  return mesh;
}

PartMesh make_fragments(std::uint32_t cells, std::uint64_t seed, double time) {
  const PartMesh ball = make_ball(cells);
  PartMesh mesh;
  mesh.vertices.resize(3 * ball.triangles.size());
  mesh.triangles.resize(ball.triangles.size());
  const auto t = static_cast<float>(time);
  parallel_for(ball.triangles.size(), 4096, [&](std::size_t i) {
    Random random(mix_bits(seed) ^ i);
    const Triangle& triangle = ball.triangles[i];
    const Vec3 corners[3] = {ball.vertices[triangle.x], ball.vertices[triangle.y], ball.vertices[triangle.z]};
    const Vec3 centre = (corners[0] + corners[1] + corners[2]) / 3.0F;
    const Vec3 path = 0.5F * centre + random_vector(random);
    const Vec3 axis = glm::normalize(random_vector(random) + 0.1F * centre);
    const Vec2 turn = unit_circle(2.0 * time * static_cast<double>(random.next_float()));
    const auto v = static_cast<std::uint32_t>(3 * i);
    for (std::uint32_t k = 0; k < 3; ++k) {
      const Vec3 d = corners[k] - centre;
      // Rodrigues' formula.
      const Vec3 turned = turn.x * d + turn.y * glm::cross(axis, d) + (1.0F - turn.x) * glm::dot(axis, d) * axis;
      mesh.vertices[v + k] = centre + t * path + turned;
    }
    mesh.triangles[i] = {v, v + 1, v + 2};
  });
  return mesh;
}

}  // namespace

Scene make_shatter(const BuiltinOptions& options) {
  options.allow_only({"size", "triangles", "primitives", "seed", "time"});
  std::uint64_t cells = options.integer("size", 80, 1, kMostCells);
  if (const std::uint64_t target = options.target(); target > 0) cells = nearest_size(target, 1, kMostCells, triangle_count);
  SceneBuilder builder;
  builder.add_mesh("fragments", make_fragments(static_cast<std::uint32_t>(cells), options.seed(), options.number("time", 0.0, 0.0, 1.0)),
                   builder.add_material(plastic({0.7F, 0.3F, 0.12F}, 0.3F)));
  builder.set_constant_sky({0.75F, 0.82F, 0.95F});
  builder.add_sun({-0.5F, -0.8F, -0.4F}, {2.6F, 2.4F, 2.1F});
  return builder.finish(look_at({2.6F, 1.7F, 3.4F}, {0.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}, 0.75F));
}

}  // namespace grove
