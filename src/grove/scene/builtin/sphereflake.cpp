// A sphere with nine spheres of a third of its radius on it, each with nine on it, and so on: six around the equator, three above, as in
// Eric Haines' Standard Procedural Databases (1987, "A Proposal for Standard Graphics Environments").

#include <cmath>
#include <string>

#include "grove/scene/builtin/generators.h"
#include "grove/scene/builtin/scene_builder.h"
#include "grove/scene/builtin/shapes.h"

namespace grove {
namespace {

constexpr std::uint32_t kMaxDepth = 7;   // 5,380,840 spheres
constexpr std::uint32_t kMaxDetail = 5;  // 20,480 triangles a sphere
constexpr std::uint64_t kFloorTriangles = 2;

std::uint64_t sphere_count(std::uint64_t depth) {
  std::uint64_t count = 0;
  std::uint64_t level = 1;
  for (std::uint64_t d = 0; d <= depth; ++d, level *= 9) count += level;
  return count;
}

// The nine directions for a sphere whose parent lies at -z.
std::vector<Vec3> child_directions() {
  std::vector<Vec3> directions;
  for (int i = 0; i < 6; ++i) {
    const Vec2 c = unit_circle(i / 6.0);
    directions.emplace_back(c.x, c.y, 0.0F);
  }
  // In the gaps of the six, as in a dense packing of equal spheres: elevation asin(sqrt(2/3)).
  for (int i = 0; i < 3; ++i) {
    const Vec2 c = unit_circle(i / 3.0 + 1.0 / 12.0);
    directions.emplace_back(std::sqrt(1.0F / 3.0F) * c.x, std::sqrt(1.0F / 3.0F) * c.y, std::sqrt(2.0F / 3.0F));
  }
  return directions;
}

struct Placed {
  SphereSet::Sphere sphere;
  Vec3 axis;  // away from the parent
};

std::vector<Placed> next_level(const std::vector<Placed>& parents, const std::vector<Vec3>& directions) {
  std::vector<Placed> children;
  children.reserve(parents.size() * directions.size());
  for (const Placed& parent : parents) {
    const Frame frame = frame_around(parent.axis);
    const float radius = parent.sphere.radius / 3.0F;
    for (const Vec3& d : directions) {
      const Vec3 axis = glm::normalize(d.x * frame.x + d.y * frame.y + d.z * parent.axis);
      children.push_back({{parent.sphere.centre + (parent.sphere.radius + radius) * axis, radius}, axis});
    }
  }
  return children;
}

struct Size {
  std::uint32_t depth;
  std::uint32_t detail;
};

Size choose_size(const BuiltinOptions& options, bool triangles) {
  const auto count = [&](const Size& s) {
    return sphere_count(s.depth) * (triangles ? geodesic_triangles(s.detail) : 1) + kFloorTriangles;
  };
  Size size{static_cast<std::uint32_t>(options.integer("size", 4, 0, kMaxDepth)),
            static_cast<std::uint32_t>(options.integer("detail", 1, 0, kMaxDetail))};
  if (const std::uint64_t target = options.target(); target > 0) {
    const auto distance = [&](const Size& s) { return count(s) > target ? count(s) - target : target - count(s); };
    size.depth = 0;
    for (std::uint32_t depth = 0; depth <= kMaxDepth; ++depth) {
      for (std::uint32_t detail = 0; detail <= kMaxDetail; ++detail) {
        const Size candidate{depth, triangles && !options.has("detail") ? detail : size.detail};
        if (distance(candidate) < distance(size)) size = candidate;
      }
    }
  }
  if (count(size) > kMaxBuiltinPrimitives) options.fail("more than 200000000 triangles; lower size or detail");
  return size;
}

}  // namespace

Scene make_sphereflake(const BuiltinOptions& options) {
  options.allow_only({"size", "triangles", "primitives", "shape", "tessellate", "detail"});
  const bool triangles = options.choice("shape", {"spheres", "triangles"}) == "triangles" || options.boolean("tessellate", "false");
  const Size size = choose_size(options, triangles);

  SceneBuilder builder;
  Material tiles = plastic(Vec3(1.0F), 0.35F);
  tiles.base_colour.texture = builder.add_checkerboard({0.42F, 0.44F, 0.47F}, {0.12F, 0.13F, 0.15F}, 24.0F);
  const std::uint32_t floor = builder.add_material(std::move(tiles));
  const std::uint32_t by_level[] = {
      builder.add_material(metal({0.95F, 0.93F, 0.88F}, 0.05F)), builder.add_material(metal({1.0F, 0.72F, 0.32F}, 0.15F)),
      builder.add_material(plastic({0.55F, 0.04F, 0.03F}, 0.2F)), builder.add_material(metal({0.95F, 0.64F, 0.54F}, 0.2F))};

  PartMesh ground;
  add_ground(ground, {0.0F, -1.35F, 0.0F}, 24.0F);
  builder.add_mesh("floor", std::move(ground), floor);

  const PartMesh shape = triangles ? geodesic_sphere(size.detail) : PartMesh();
  const std::vector<Vec3> directions = child_directions();
  std::vector<Placed> level{{{Vec3(0.0F), 0.8F}, glm::normalize(Vec3(0.12F, 1.0F, 0.08F))}};
  for (std::uint32_t depth = 0; depth <= size.depth; ++depth) {
    std::vector<SphereSet::Sphere> spheres;
    spheres.reserve(level.size());
    for (const Placed& placed : level) spheres.push_back(placed.sphere);
    const std::string name = "level " + std::to_string(depth);
    if (triangles) {
      PartMesh mesh;
      add_spheres(mesh, shape, spheres);
      builder.add_mesh(name, std::move(mesh), by_level[depth % 4]);
    } else {
      builder.add_spheres(name, std::move(spheres), by_level[depth % 4]);
    }
    if (depth < size.depth) level = next_level(level, directions);
  }
  builder.set_sky({0.18F, 0.36F, 0.8F}, {0.85F, 0.88F, 0.92F}, {0.2F, 0.19F, 0.18F});
  builder.add_sun({-0.6F, -0.75F, -0.45F}, {3.4F, 3.1F, 2.6F});
  return builder.finish(look_at({2.1F, 1.5F, 3.4F}, {0.0F, -0.08F, 0.0F}, {0.0F, 1.0F, 0.0F}, 0.7F));
}

}  // namespace grove
