// A wall of meshing gears, after "gears" of Eric Haines' Standard Procedural Databases (1987): long thin triangles on the faces, many small ones
// on the teeth.

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "grove/scene/builtin/generators.h"
#include "grove/scene/builtin/scene_builder.h"
#include "grove/scene/builtin/shapes.h"

namespace grove {
namespace {

constexpr std::uint64_t kMaxSide = 400;
constexpr std::uint64_t kMinTeeth = 8;
constexpr std::uint64_t kMaxTeeth = 4000;
constexpr std::uint64_t kTeeth = 24;
constexpr std::uint32_t kColours = 3;
constexpr float kPitchRadius = 0.5F;  // where gears touch: they stand one unit apart
constexpr float kThickness = 0.22F;
constexpr float kHoleRadius = 0.17F;

// Four points a tooth; an outer wall, an inner wall and two faces of two triangles for each point.
std::uint64_t triangle_count(std::uint64_t side, std::uint64_t teeth) {
  return side * side * teeth * 4 * 8 + 4;
}

// The outline as (cos, sin) * radius: up the flank, across the top, down, across the bottom.
std::vector<Vec2> outline(std::uint32_t teeth, double phase) {
  const float depth = 1.6F / static_cast<float>(teeth);
  std::vector<Vec2> points;
  const double corners[4] = {-0.32, -0.16, 0.16, 0.32};  // in teeth, around the middle of one
  for (std::uint32_t tooth = 0; tooth < teeth; ++tooth) {
    for (int c = 0; c < 4; ++c) {
      const float radius = c == 1 || c == 2 ? kPitchRadius + 0.45F * depth : kPitchRadius - 0.55F * depth;
      points.push_back(radius * unit_circle((tooth + corners[c] + phase) / teeth));
    }
  }
  return points;
}

// A band of quads between two rings of points, in flat shading: vertices are not shared between quads.
void add_band(PartMesh& mesh, const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const std::size_t j = (i + 1) % a.size();
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), {a[i], a[j], b[j], b[i]});
    mesh.triangles.emplace_back(first, first + 1, first + 2);
    mesh.triangles.emplace_back(first, first + 2, first + 3);
  }
}

void add_gear(PartMesh& mesh, const Vec3& centre, std::uint32_t teeth, double phase) {
  const std::vector<Vec2> rim = outline(teeth, phase);
  const Vec3 half(0.0F, 0.0F, 0.5F * kThickness);
  std::vector<Vec3> rim_front;
  std::vector<Vec3> rim_back;
  std::vector<Vec3> hole_front;
  std::vector<Vec3> hole_back;
  for (const Vec2& p : rim) {
    const Vec3 outer = centre + Vec3(p, 0.0F);
    const Vec3 inner = centre + Vec3(kHoleRadius * glm::normalize(p), 0.0F);
    rim_front.push_back(outer + half);
    rim_back.push_back(outer - half);
    hole_front.push_back(inner + half);
    hole_back.push_back(inner - half);
  }
  add_band(mesh, rim_back, rim_front);
  add_band(mesh, rim_front, hole_front);
  add_band(mesh, hole_front, hole_back);
  add_band(mesh, hole_back, rim_back);
}

}  // namespace

Scene make_gears(const BuiltinOptions& options) {
  options.allow_only({"size", "triangles", "primitives", "teeth"});
  std::uint64_t side = options.integer("size", 6, 1, kMaxSide);
  std::uint64_t teeth = options.integer("teeth", kTeeth, kMinTeeth, kMaxTeeth);
  // Neighbours to the right and above mesh alike only if a quarter turn is a whole number of teeth.
  if (teeth % 4 != 0) options.fail("value " + std::to_string(teeth) + " of teeth; allowed are multiples of 4");
  if (const std::uint64_t target = options.target(); target > 0) {
    side = nearest_size(target, 1, kMaxSide, [&](std::uint64_t s) { return triangle_count(s, teeth); });
    if (!options.has("teeth")) {
      teeth = 4 * nearest_size(target, kMinTeeth / 4, kMaxTeeth / 4, [&](std::uint64_t t) { return triangle_count(side, 4 * t); });
    }
  }
  if (triangle_count(side, teeth) > kMaxBuiltinPrimitives) options.fail("more than 200000000 triangles; lower size or teeth");

  SceneBuilder builder;
  const float width = static_cast<float>(side);
  PartMesh room;
  add_ground(room, {0.0F, 0.0F, 0.0F}, 20.0F * width);
  add_grid(room, {-20.0F * width, 0.0F, -0.45F}, {40.0F * width, 0.0F, 0.0F}, {0.0F, 40.0F * width, 0.0F}, 1);
  builder.add_mesh("floor and wall", std::move(room), builder.add_material(matte({0.16F, 0.19F, 0.24F})));

  PartMesh gears[kColours];
  for (std::uint64_t j = 0; j < side; ++j) {
    for (std::uint64_t i = 0; i < side; ++i) {
      const Vec3 centre(static_cast<float>(i) - 0.5F * (width - 1.0F), 0.6F + static_cast<float>(j), 0.0F);
      // Where one has a tooth its neighbour has a gap.
      const double phase = (i + j) % 2 == 0 ? 0.0 : 0.5;
      add_gear(gears[(i + 2 * j) % kColours], centre, static_cast<std::uint32_t>(teeth), phase);
    }
  }
  const std::uint32_t metals[kColours] = {builder.add_material(metal({0.92F, 0.68F, 0.3F}, 0.3F)),
                                          builder.add_material(metal({0.75F, 0.76F, 0.78F}, 0.3F)),
                                          builder.add_material(metal({0.9F, 0.46F, 0.3F}, 0.35F))};
  for (std::uint32_t c = 0; c < kColours; ++c) {
    if (!gears[c].triangles.empty()) builder.add_mesh("gears " + std::to_string(c), std::move(gears[c]), metals[c]);
  }
  builder.set_sky({0.5F, 0.6F, 0.8F}, {1.0F, 0.97F, 0.92F}, {0.3F, 0.3F, 0.3F});
  builder.add_sun({0.5F, -0.6F, -0.75F}, {2.8F, 2.6F, 2.3F});
  return builder.finish(
      look_at(width * Vec3(-0.55F, 0.62F, 1.25F), width * Vec3(0.0F, 0.5F, 0.0F) + Vec3(0.0F, 0.1F, 0.0F), {0.0F, 1.0F, 0.0F}, 0.8F));
}

}  // namespace grove
