// Spheres of one size in a cube, uniform or in clusters; their radius follows from their number so that they fill the same part of it.

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "grove/base/random.h"
#include "grove/scene/builtin/generators.h"
#include "grove/scene/builtin/scene_builder.h"
#include "grove/scene/builtin/shapes.h"

namespace grove {
namespace {

constexpr std::uint32_t kColours = 4;
constexpr double kVolumeFraction = 0.03;
constexpr std::uint64_t kMaxSpheres = 50'000'000;
constexpr std::uint32_t kClusters = 12;

Vec3 random_point(Random& random) {
  Vec3 p;
  for (int axis = 0; axis < 3; ++axis) p[axis] = random.next_float(-1.0F, 1.0F);
  return p;
}

// The mean of four uniform points: nearly a normal distribution (Irwin-Hall), without logarithms.
Vec3 random_offset(Random& random) {
  Vec3 sum(0.0F);
  for (int i = 0; i < 4; ++i) sum += random_point(random);
  return 0.25F * sum;
}

}  // namespace

Scene make_spheres(const BuiltinOptions& options) {
  options.allow_only({"size", "triangles", "primitives", "seed", "layout", "shape", "detail"});
  const bool triangles = options.choice("shape", {"spheres", "triangles"}) == "triangles";
  const bool clustered = options.choice("layout", {"uniform", "clustered"}) == "clustered";
  const auto detail = static_cast<std::uint32_t>(options.integer("detail", 1, 0, 5));
  const std::uint64_t each = triangles ? geodesic_triangles(detail) : 1;
  std::uint64_t count = options.integer("size", 5000, 1, kMaxSpheres);
  if (const std::uint64_t target = options.target(); target > 0) {
    count = nearest_size(target, 1, kMaxSpheres, [&](std::uint64_t n) { return n * each; });
  }
  if (count * each > kMaxBuiltinPrimitives) options.fail("more than 200000000 triangles; lower size or detail");

  // fraction * 8 = count * 4/3 pi r^3 in the cube from -1 to 1.
  const auto radius = static_cast<float>(std::cbrt(kVolumeFraction * 8.0 * 3.0 / (4.0 * std::numbers::pi * static_cast<double>(count))));
  Random random(options.seed());
  std::vector<Vec3> clusters;
  for (std::uint32_t i = 0; i < kClusters; ++i) clusters.push_back(0.8F * random_point(random));
  std::vector<SphereSet::Sphere> by_colour[kColours];
  for (std::uint64_t i = 0; i < count; ++i) {
    Vec3 centre(0.0F);
    if (clustered) {
      const Vec3& cluster = clusters[random.next_u32(kClusters)];
      centre = cluster + 0.35F * random_offset(random);
    } else {
      centre = random_point(random);
    }
    by_colour[i % kColours].push_back({centre, radius});
  }

  SceneBuilder builder;
  const std::uint32_t materials[kColours] = {
      builder.add_material(plastic({0.72F, 0.1F, 0.06F}, 0.25F)), builder.add_material(metal({1.0F, 0.78F, 0.4F}, 0.2F)),
      builder.add_material(plastic({0.05F, 0.28F, 0.5F}, 0.25F)), builder.add_material(plastic({0.82F, 0.8F, 0.75F}, 0.3F))};
  const PartMesh shape = triangles ? geodesic_sphere(detail) : PartMesh();
  for (std::uint32_t c = 0; c < kColours && c < count; ++c) {
    const std::string name = "spheres " + std::to_string(c);
    if (triangles) {
      PartMesh mesh;
      add_spheres(mesh, shape, by_colour[c]);
      builder.add_mesh(name, std::move(mesh), materials[c]);
    } else {
      builder.add_spheres(name, std::move(by_colour[c]), materials[c]);
    }
  }
  builder.set_sky({0.3F, 0.45F, 0.8F}, {0.9F, 0.92F, 0.95F}, {0.35F, 0.33F, 0.3F});
  builder.add_sun({-0.5F, -0.8F, -0.4F}, {3.0F, 2.8F, 2.4F});
  return builder.finish(look_at({2.4F, 1.6F, 3.2F}, {0.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}, 0.75F));
}

}  // namespace grove
