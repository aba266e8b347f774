// Fractal terrain on a square grid of any number of cells: ridged multifractal noise (Musgrave, Kolb, Mace 1989, "The Synthesis and Rendering
// of Eroded Fractal Terrains") rather than the midpoint displacement of Haines' "mount", whose grids must be powers of two. Every height is a
// function of its place alone, so that rows are made in parallel, and by additions and products only, so that all machines agree.

#include <algorithm>
#include <cmath>
#include <utility>

#include "grove/base/parallel.h"
#include "grove/base/random.h"
#include "grove/scene/builtin/generators.h"
#include "grove/scene/builtin/scene_builder.h"
#include "grove/scene/builtin/shapes.h"

namespace grove {
namespace {

constexpr std::uint64_t kMaxCells = 10000;
// Normals and colours are kept up to this many vertices; beyond, a triangle is smaller than a pixel and 28 bytes a vertex are not worth it.
constexpr std::uint64_t kMaxShadedVertices = 1'500'000;
constexpr float kHalfWidth = 4.0F;
constexpr std::uint32_t kBalls = 4;

// A number in [-1, 1) for each point of the integer lattice.
float lattice(std::uint64_t seed, std::int64_t x, std::int64_t y) {
  const std::uint64_t bits = mix_bits(mix_bits(seed ^ static_cast<std::uint64_t>(x)) + static_cast<std::uint64_t>(y));
  return static_cast<float>(bits >> 40) * 0x1p-23F - 1.0F;
}

// Smooth value noise in [-1, 1): lattice numbers joined by Perlin's quintic, which has no second derivative at the lattice.
float noise(std::uint64_t seed, float x, float y) {
  const float fx = std::floor(x);
  const float fy = std::floor(y);
  const auto ix = static_cast<std::int64_t>(fx);
  const auto iy = static_cast<std::int64_t>(fy);
  const auto ease = [](float t) { return t * t * t * (t * (6.0F * t - 15.0F) + 10.0F); };
  const float u = ease(x - fx);
  const float v = ease(y - fy);
  const float a = lattice(seed, ix, iy);
  const float b = lattice(seed, ix + 1, iy);
  const float c = lattice(seed, ix, iy + 1);
  const float d = lattice(seed, ix + 1, iy + 1);
  const float bottom = a + u * (b - a);
  return bottom + v * (c + u * (d - c) - bottom);
}

class Terrain {
 public:
  Terrain(std::uint64_t seed, std::uint32_t cells) : seed_(seed), cells_(cells) {
    // Detail down to two cells.
    while (octaves_ < 12 && (8U << octaves_) < cells) ++octaves_;
  }

  [[nodiscard]] Vec3 vertex(std::int64_t i, std::int64_t j) const {
    const float x = kHalfWidth * (2.0F * static_cast<float>(i) / static_cast<float>(cells_) - 1.0F);
    const float z = kHalfWidth * (2.0F * static_cast<float>(j) / static_cast<float>(cells_) - 1.0F);
    return {x, height(x, z), z};
  }

  // From the neighbours on the grid.
  [[nodiscard]] Vec3 normal(std::int64_t i, std::int64_t j) const {
    return glm::normalize(glm::cross(vertex(i, j + 1) - vertex(i, j - 1), vertex(i + 1, j) - vertex(i - 1, j)));
  }

  [[nodiscard]] float height(float x, float z) const {
    float sum = 0.0F;
    float amplitude = 0.5F;
    float frequency = 0.45F;
    float weight = 1.0F;
    for (std::uint32_t octave = 0; octave < octaves_; ++octave) {
      // 1 - |noise| has ridges; each octave is weaker where the one before is low, so that valleys are smooth.
      float ridge = 1.0F - std::fabs(noise(seed_ + octave, frequency * x + 17.3F, frequency * z + 9.7F));
      ridge *= ridge;
      sum += amplitude * weight * ridge;
      weight = std::clamp(1.6F * ridge, 0.0F, 1.0F);
      amplitude *= 0.5F;
      frequency *= 2.03F;
    }
    // The massif falls off toward the border.
    const float r2 = (x * x + z * z) / (kHalfWidth * kHalfWidth);
    const float rise = std::fmax(0.0F, 1.0F - 0.5F * r2);
    return 2.4F * sum * rise * rise - 1.0F;
  }

 private:
  std::uint64_t seed_;
  std::uint32_t cells_;
  std::uint32_t octaves_ = 3;
};

// Meadow below, rock where it is steep or higher up, snow on top; linear RGB.
Vec4 ground_colour(const Vec3& position, const Vec3& normal) {
  const Vec3 meadow(0.09F, 0.13F, 0.035F);
  const Vec3 rock(0.19F, 0.165F, 0.14F);
  const Vec3 snow(0.86F, 0.88F, 0.92F);
  const float flat = std::clamp((normal.y - 0.6F) / 0.2F, 0.0F, 1.0F);
  const float low = std::clamp((-0.15F - position.y) / 0.35F, 0.0F, 1.0F);
  const float high = std::clamp((position.y - 0.3F) / 0.25F, 0.0F, 1.0F);
  Vec3 colour = rock + low * flat * (meadow - rock);
  colour += high * std::clamp((normal.y - 0.45F) / 0.2F, 0.0F, 1.0F) * (snow - colour);
  return {colour, 1.0F};
}

PartMesh make_terrain(const Terrain& terrain, std::uint32_t cells) {
  const std::size_t row = std::size_t{cells} + 1;
  PartMesh mesh;
  mesh.vertices.resize(row * row);
  mesh.triangles.resize(std::size_t{2} * cells * cells);
  const bool shaded = row * row <= kMaxShadedVertices;
  if (shaded) {
    mesh.normals.resize(row * row);
    mesh.colours.resize(row * row);
  }
  parallel_for(row, 8, [&](std::size_t j) {
    for (std::size_t i = 0; i < row; ++i) {
      const std::size_t v = j * row + i;
      const auto x = static_cast<std::int64_t>(i);
      const auto y = static_cast<std::int64_t>(j);
      mesh.vertices[v] = terrain.vertex(x, y);
      if (shaded) {
        mesh.normals[v] = terrain.normal(x, y);
        mesh.colours[v] = ground_colour(mesh.vertices[v], mesh.normals[v]);
      }
      if (i == cells || j == cells) continue;
      const auto a = static_cast<std::uint32_t>(v);
      const auto d = static_cast<std::uint32_t>(v + row);
      Triangle* const pair = &mesh.triangles[2 * (j * cells + i)];
      pair[0] = {a, d, d + 1};
      pair[1] = {a, d + 1, a + 1};
    }
  });
  return mesh;
}

}  // namespace

Scene make_mount(const BuiltinOptions& options) {
  options.allow_only({"size", "triangles", "primitives", "seed", "spheres"});
  const bool balls = options.boolean("spheres", "true");
  const auto count = [&](std::uint64_t n) { return 2 * n * n + (balls ? kBalls : 0); };
  std::uint64_t size = options.integer("size", 400, 1, kMaxCells);
  if (const std::uint64_t target = options.target(); target > 0) size = nearest_size(target, 1, kMaxCells, count);
  const auto cells = static_cast<std::uint32_t>(size);
  const Terrain terrain(options.seed(), cells);

  SceneBuilder builder;
  PartMesh mesh = make_terrain(terrain, cells);
  Material ground = matte(mesh.colours.empty() ? Vec3(0.24F, 0.21F, 0.18F) : Vec3(1.0F));
  ground.name = "ground";
  builder.add_mesh("terrain", std::move(mesh), builder.add_material(std::move(ground)));
  if (balls) {
    const Vec2 places[kBalls] = {{-1.35F, 2.35F}, {1.45F, 2.1F}, {0.25F, 2.75F}, {2.3F, 0.9F}};
    const std::uint32_t mirror = builder.add_material(metal({0.95F, 0.93F, 0.88F}, 0.04F));
    for (const Vec2& place : places) {
      const float radius = 0.2F;
      builder.add_spheres("ball", {{.centre = {place.x, terrain.height(place.x, place.y) + 1.6F * radius, place.y}, .radius = radius}},
                          mirror);
    }
  }
  builder.set_sky({0.16F, 0.33F, 0.78F}, {0.8F, 0.85F, 0.92F}, {0.5F, 0.54F, 0.6F});
  builder.add_sun({0.75F, -0.5F, -0.35F}, {3.9F, 3.3F, 2.5F});
  return builder.finish(look_at({0.6F, 0.7F, 5.4F}, {0.0F, -0.05F, 0.0F}, {0.0F, 1.0F, 0.0F}, 0.75F));
}

}  // namespace grove
