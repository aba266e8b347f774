#include "registry/matrix_rays.h"

#include <cmath>
#include <limits>

#include "grove/base/random.h"

namespace grove::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Vec3 point_in(const Box& box, Random& random) {
  Vec3 p;
  for (int axis = 0; axis < 3; ++axis) p[axis] = box.lower[axis] + (box.upper[axis] - box.lower[axis]) * random.next_float();
  return p;
}

Vec3 random_direction(Random& random) {
  for (;;) {
    const Vec3 d(random.next_float(-1, 1), random.next_float(-1, 1), random.next_float(-1, 1));
    if (glm::dot(d, d) > 0.01F) return d;
  }
}

// A special point of a primitive: a corner, a point of an edge, or one of its box.
Vec3 target(const GeometryPointer& geometry, Random& random) {
  const std::size_t size = size_of(geometry);
  if (size == 0) return Vec3(0.5F);
  const std::size_t i = random.next_u32(static_cast<std::uint32_t>(size));
  if (const auto* mesh = std::get_if<std::shared_ptr<const TriangleMesh>>(&geometry)) {
    const Triangle& triangle = (*mesh)->triangles()[i];
    const int corner = static_cast<int>(random.next_u32(3));
    const Vec3 a = (*mesh)->vertices()[triangle[corner]];
    const Vec3 b = (*mesh)->vertices()[triangle[(corner + 1) % 3]];
    switch (random.next_u32(4)) {
      case 0:
        return a;
      case 1:
        return a + (b - a) * 0.5F;
      case 2:
        return a + (b - a) * random.next_float();
      default:
        break;
    }
  }
  const Box box = bounds_of(geometry, i);
  if (box.is_empty()) return Vec3(0.5F);
  Vec3 p = point_in(box, random);
  for (int axis = 0; axis < 3; ++axis) {
    const std::uint32_t choice = random.next_u32(3);
    if (choice == 0) p[axis] = box.lower[axis];
    if (choice == 1) p[axis] = box.upper[axis];
  }
  return p;
}

float tiny(Random& random) {
  constexpr float kTiny[] = {0.0F, -0.0F, 1e-40F, -1e-44F, 1e-30F, -1e-20F};
  return kTiny[random.next_u32(6)];
}

}  // namespace

std::vector<Ray> matrix_rays(const GeometryPointer& geometry, std::size_t scale, std::uint64_t seed) {
  Random random(seed);
  Box bounds;
  for (std::size_t i = 0; i < size_of(geometry); ++i) bounds.grow(bounds_of(geometry, i));
  if (bounds.is_empty()) bounds = {Vec3(0.0F), Vec3(1.0F)};
  const Vec3 side = bounds.extent();
  const Box outside{bounds.lower - 0.5F * side, bounds.upper + 0.5F * side};

  std::vector<Ray> rays;
  const auto add = [&](const Vec3& origin, const Vec3& direction, float t_min = 0.0F, float t_max = kInfinity) {
    rays.push_back({origin, t_min, direction, t_max});
  };
  for (std::size_t i = 0; i < scale; ++i) {
    // Anywhere, in any direction, and through the scene.
    add(point_in(outside, random), random_direction(random));
    const Vec3 from = point_in(outside, random);
    add(from, point_in(bounds, random) - from);
    add(from, point_in(bounds, random) - from, 0.3F, 0.9F);
    // Towards special points, and beginning or ending on them.
    const Vec3 aim = target(geometry, random);
    add(from, aim - from);
    add(from, aim - from, 0.0F, 1.0F);
    add(from, aim - from, 1.0F);
    add(from, aim - from, 1.0F, 1.0F);
    add(aim, random_direction(random));
    add(aim, target(geometry, random) - aim);
    // Along the axes through special points: in box planes, along edges, with zeros of both signs and almost-zeros.
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 origin = aim;
      origin[axis] = outside.lower[axis];
      Vec3 direction(tiny(random), tiny(random), tiny(random));
      direction[axis] = random.next_float(0.5F, 2.0F);
      add(origin, direction);
      origin[axis] = outside.upper[axis];
      direction[axis] = -direction[axis];
      add(origin, direction);
    }
    // In an axis plane through a special point.
    Vec3 in_plane = random_direction(random);
    in_plane[static_cast<int>(random.next_u32(3))] = random.next_u32(2) == 0 ? 0.0F : -0.0F;
    add(aim - in_plane * (0.25F * (side.x + side.y + side.z)), in_plane);
    // Directions of extreme length.
    add(from, (aim - from) * 1e-30F);
    add(from, glm::normalize(aim - from) * 1e30F);
    add(from, (aim - from) * 1e-38F);
  }
  // What hits nothing by definition, whatever lies in its way.
  const Vec3 middle = bounds.centre();
  const Vec3 ahead(1.0F, 0.5F, 0.25F);
  add(Vec3(kNan, 0.0F, 0.0F), ahead);
  add(middle, Vec3(0.0F, kNan, 1.0F));
  add(middle, ahead, kNan);
  add(middle, ahead, 0.0F, kNan);
  add(middle, Vec3(0.0F));
  add(middle, Vec3(0.0F, -0.0F, 0.0F));
  add(Vec3(kInfinity, 0.0F, 0.0F), ahead);
  add(middle, Vec3(kInfinity, 0.0F, 0.0F));
  add(middle, ahead, 2.0F, 1.0F);
  add(middle, ahead, 0.0F, -1.0F);
  add(middle, ahead, kInfinity, kInfinity);
  // Legal extremes.
  add(middle, ahead, -kInfinity, kInfinity);
  add(middle, ahead, -1.0F, 0.0F);
  add(middle, ahead, 0.0F, 0.0F);
  add(middle - ahead * 1e18F, ahead);
  add(middle, ahead * 3e38F);
  add(middle, Vec3(1e-45F, -1e-45F, 1e-45F));
  return rays;
}

}  // namespace grove::test
