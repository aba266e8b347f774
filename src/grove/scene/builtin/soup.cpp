// Random long thin triangles in a cube: the worst case for axis-aligned boxes, since most of each box is empty.

#include <cmath>
#include <string>
#include <utility>

#include "grove/base/parallel.h"
#include "grove/base/random.h"
#include "grove/scene/builtin/generators.h"
#include "grove/scene/builtin/scene_builder.h"

namespace grove {
namespace {

constexpr std::uint32_t kColours = 4;

// A direction, uniform over the sphere, by rejection: without trigonometry, and so the same on every machine.
Vec3 random_direction(Random& random) {
  for (;;) {
    const float x = random.next_float(-1.0F, 1.0F);
    const float y = random.next_float(-1.0F, 1.0F);
    const float z = random.next_float(-1.0F, 1.0F);
    const float squared = x * x + y * y + z * z;
    if (squared > 0.01F && squared <= 1.0F) return Vec3(x, y, z) / std::sqrt(squared);
  }
}

// Triangles first, first + step, first + 2 step, ... of the soup; each has a generator of its own, so that any may be made alone.
PartMesh make_soup_part(std::uint64_t seed, std::uint64_t count, std::uint64_t first, float length, float width) {
  const std::uint64_t own = (count + kColours - 1 - first) / kColours;
  PartMesh mesh;
  mesh.vertices.resize(3 * own);
  mesh.triangles.resize(own);
  parallel_for(own, 4096, [&](std::size_t k) {
    Random random(mix_bits(seed) ^ (first + kColours * k));
    // One call a statement, because the order in which arguments are evaluated is the compiler's choice.
    Vec3 centre;
    for (int axis = 0; axis < 3; ++axis) centre[axis] = random.next_float(-1.0F, 1.0F);
    const Vec3 along = random_direction(random);
    const Vec3 across = glm::normalize(glm::cross(along, random_direction(random)) + 1e-3F * along);
    const float half = 0.5F * length * random.next_float(0.5F, 1.0F);
    const auto v = static_cast<std::uint32_t>(3 * k);
    mesh.vertices[v] = centre - half * along - width * across;
    mesh.vertices[v + 1] = centre - half * along + width * across;
    mesh.vertices[v + 2] = centre + half * along;
    mesh.triangles[k] = {v, v + 1, v + 2};
  });
  return mesh;
}

}  // namespace

Scene make_soup(const BuiltinOptions& options) {
  options.allow_only({"size", "triangles", "primitives", "seed"});
  std::uint64_t count = options.integer("size", 20000, 1, kMaxBuiltinPrimitives);
  if (const std::uint64_t target = options.target(); target > 0) count = target;
  // Length and width shrink so that the total area, and with it how deep one sees into the soup, stays about the same.
  const auto n = static_cast<double>(count);
  const auto length = static_cast<float>(4.0 / std::sqrt(std::sqrt(n)));
  const auto width = static_cast<float>(2.5 / (std::sqrt(n) * std::sqrt(std::sqrt(n))));

  SceneBuilder builder;
  const Vec3 colours[kColours] = {{0.75F, 0.16F, 0.07F}, {0.85F, 0.55F, 0.12F}, {0.07F, 0.35F, 0.55F}, {0.8F, 0.78F, 0.72F}};
  for (std::uint32_t c = 0; c < kColours && c < count; ++c) {
    builder.add_mesh("soup " + std::to_string(c), make_soup_part(options.seed(), count, c, length, width),
                     builder.add_material(plastic(colours[c], 0.4F)));
  }
  builder.set_constant_sky({0.75F, 0.82F, 0.95F});
  builder.add_sun({-0.5F, -0.8F, -0.4F}, {2.6F, 2.4F, 2.1F});
  return builder.finish(look_at({2.6F, 1.7F, 3.4F}, {0.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}, 0.75F));
}

}  // namespace grove
