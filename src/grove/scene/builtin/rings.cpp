// A pyramid of knots of three interlocked rings, after "rings" of Eric Haines' Standard Procedural Databases (1987); the rings are smooth tori
// instead of chains of spheres and cylinders.

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "grove/scene/builtin/generators.h"
#include "grove/scene/builtin/scene_builder.h"
#include "grove/scene/builtin/shapes.h"

namespace grove {
namespace {

constexpr std::uint64_t kMaxLayers = 60;
constexpr std::uint64_t kMinDetail = 3;
constexpr std::uint64_t kMaxDetail = 200;
constexpr std::uint64_t kDefaultDetail = 14;
constexpr float kRingRadius = 0.36F;
constexpr float kTubeRadius = 0.085F;

// Layers of 1, 4, 9, ... knots.
std::uint64_t knot_count(std::uint64_t layers) {
  return layers * (layers + 1) * (2 * layers + 1) / 6;
}

std::uint64_t triangle_count(std::uint64_t layers, std::uint64_t detail) {
  // A tube of 4 detail rings of `detail` sides; three for a knot; two triangles for the floor.
  return knot_count(layers) * 3 * 2 * (4 * detail) * detail + 2;
}

// A ring around `axis`.
void add_ring(PartMesh& mesh, const Vec3& centre, int axis, std::uint32_t detail) {
  const std::uint32_t segments = 4 * detail;
  std::vector<Vec3> line(segments, centre);
  for (std::uint32_t i = 0; i < segments; ++i) {
    const Vec2 c = unit_circle(static_cast<double>(i) / segments);
    line[i][(axis + 1) % 3] += kRingRadius * c.x;
    line[i][(axis + 2) % 3] += kRingRadius * c.y;
  }
  const std::vector<float> radii(segments, kTubeRadius);
  add_tube(mesh, {.centres = line, .radii = radii, .sides = detail, .closed = true});
}

}  // namespace

Scene make_rings(const BuiltinOptions& options) {
  options.allow_only({"size", "triangles", "primitives", "detail"});
  std::uint64_t layers = options.integer("size", 4, 1, kMaxLayers);
  std::uint64_t detail = options.integer("detail", kDefaultDetail, kMinDetail, kMaxDetail);
  if (const std::uint64_t target = options.target(); target > 0) {
    // As many layers as the usual detail gives, then the detail that comes nearest.
    layers = nearest_size(target, 1, kMaxLayers, [&](std::uint64_t l) { return triangle_count(l, detail); });
    if (!options.has("detail")) {
      detail = nearest_size(target, kMinDetail, kMaxDetail, [&](std::uint64_t d) { return triangle_count(layers, d); });
    }
  }
  if (triangle_count(layers, detail) > kMaxBuiltinPrimitives) options.fail("more than 200000000 triangles; lower size or detail");

  SceneBuilder builder;
  PartMesh ground;
  add_ground(ground, {0.0F, -0.45F, 0.0F}, 12.0F * static_cast<float>(layers));
  builder.add_mesh("floor", std::move(ground), builder.add_material(plastic({0.32F, 0.34F, 0.38F}, 0.5F)));

  std::array<PartMesh, 3> rings;
  for (std::uint64_t layer = 0; layer < layers; ++layer) {
    const std::uint64_t side = layers - layer;
    const float border = -0.5F * static_cast<float>(side - 1);
    for (std::uint64_t j = 0; j < side; ++j) {
      for (std::uint64_t i = 0; i < side; ++i) {
        const Vec3 centre(border + static_cast<float>(i), 0.78F * static_cast<float>(layer), border + static_cast<float>(j));
        // Each ring is moved along its neighbour's plane, so that the three pass through one another without touching.
        for (int axis = 0; axis < 3; ++axis) {
          Vec3 moved = centre;
          moved[(axis + 1) % 3] += 0.5F * kRingRadius;
          add_ring(rings[static_cast<std::size_t>(axis)], moved - Vec3(0.16F * kRingRadius), axis, static_cast<std::uint32_t>(detail));
        }
      }
    }
  }
  const std::uint32_t metals[] = {builder.add_material(metal({1.0F, 0.72F, 0.32F}, 0.18F)),
                                  builder.add_material(metal({0.93F, 0.93F, 0.95F}, 0.12F)),
                                  builder.add_material(metal({0.94F, 0.5F, 0.36F}, 0.22F))};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    builder.add_mesh("rings " + std::to_string(axis), std::move(rings[axis]), metals[axis]);
  }
  builder.set_sky({0.3F, 0.42F, 0.7F}, {1.0F, 0.98F, 0.94F}, {0.25F, 0.24F, 0.23F});
  builder.add_sun({-0.45F, -0.8F, -0.5F}, {2.6F, 2.4F, 2.1F});
  const auto size = static_cast<float>(layers);
  return builder.finish(look_at(size * Vec3(0.85F, 0.75F, 1.45F), {0.0F, 0.27F * size - 0.15F, 0.0F}, {0.0F, 1.0F, 0.0F}, 0.75F));
}

}  // namespace grove
