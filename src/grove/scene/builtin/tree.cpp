// A tree that forks into three again and again, after "tree" of Eric Haines' Standard Procedural Databases (1987), with tapered branches and
// leaves of two triangles each.

#include <algorithm>
#include <cmath>
#include <utility>

#include "grove/base/random.h"
#include "grove/scene/builtin/generators.h"
#include "grove/scene/builtin/scene_builder.h"
#include "grove/scene/builtin/shapes.h"

namespace grove {
namespace {

constexpr std::uint64_t kMaxDepth = 12;
constexpr std::uint64_t kForks = 3;
constexpr std::uint64_t kLeaves = 12;  // on each of the last twigs
constexpr std::uint64_t kMaxLeaves = 400;
constexpr std::uint32_t kSides = 7;
constexpr std::uint32_t kSpans = 2;  // pieces of a branch, so that it can bend

std::uint64_t tip_count(std::uint64_t depth) {
  std::uint64_t tips = 1;
  for (std::uint64_t d = 0; d < depth; ++d) tips *= kForks;
  return tips;
}

std::uint64_t triangle_count(std::uint64_t depth, std::uint64_t leaves) {
  const std::uint64_t branches = (kForks * tip_count(depth) - 1) / (kForks - 1);
  return branches * 2 * kSides * kSpans + tip_count(depth) * leaves * 2 + 2;
}

class Grower {
 public:
  Grower(std::uint64_t seed, std::uint64_t depth, std::uint64_t leaves) : random_(seed), depth_(depth), leaves_(leaves) {}

  void grow() { branch({0.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}, 1.1F, 0.13F, 0); }

  PartMesh wood;
  PartMesh foliage;

 private:
  float jitter(float amount) { return random_.next_float(-amount, amount); }

  // Draws come in a fixed order: x, then y, then z.
  Vec3 jitter_vector(float amount) {
    Vec3 v;
    for (int axis = 0; axis < 3; ++axis) v[axis] = jitter(amount);
    return v;
  }

  void branch(const Vec3& start, const Vec3& direction, float length, float radius, std::uint64_t level) {
    const Vec3 bend = jitter_vector(0.12F * length);
    const Vec3 middle = start + 0.5F * length * direction + bend;
    const Vec3 end = start + length * direction;
    const float end_radius = 0.62F * radius;
    const Vec3 line[kSpans + 1] = {start, middle, end};
    const float radii[kSpans + 1] = {radius, 0.5F * (radius + end_radius), end_radius};
    add_tube(wood, {.centres = line, .radii = radii, .sides = kSides, .closed = false});
    if (level == depth_) {
      for (std::uint64_t i = 0; i < leaves_; ++i) leaf(start, end, length);
      return;
    }
    const Vec3 onward = glm::normalize(end - middle);
    const Frame frame = frame_around(onward);
    const double turn = random_.next_float();
    for (std::uint64_t fork = 0; fork < kForks; ++fork) {
      const Vec2 c = unit_circle(turn + static_cast<double>(fork) / kForks + jitter(0.06F));
      const float spread = 0.75F + jitter(0.2F);
      // Up, so that the crown grows to the light.
      const Vec3 next = glm::normalize(onward + spread * (c.x * frame.x + c.y * frame.y) + Vec3(0.0F, 0.12F, 0.0F));
      const float shorter = 0.74F + jitter(0.08F);
      branch(end, next, shorter * length, end_radius, level + 1);
    }
  }

  // A kite of two triangles near the twig.
  void leaf(const Vec3& start, const Vec3& end, float length) {
    const float along = random_.next_float(0.2F, 1.1F);
    const Vec3 foot = start + along * (end - start) + jitter_vector(0.18F * length);
    const Vec3 tip_direction = glm::normalize(end - start + jitter_vector(1.4F * length) + Vec3(0.0F, -0.1F * length, 0.0F));
    const Frame frame = frame_around(tip_direction);
    const Vec2 c = unit_circle(random_.next_float());
    const Vec3 side = c.x * frame.x + c.y * frame.y;
    const float size = leaf_size() * random_.next_float(0.7F, 1.3F);
    const auto first = static_cast<std::uint32_t>(foliage.vertices.size());
    const Vec3 widest = foot + 0.45F * size * tip_direction;
    foliage.vertices.insert(foliage.vertices.end(),
                            {foot, widest + 0.28F * size * side, foot + size * tip_direction, widest - 0.28F * size * side});
    foliage.triangles.emplace_back(first, first + 1, first + 2);
    foliage.triangles.emplace_back(first, first + 2, first + 3);
  }

  // Smaller where there are more, so that the crown keeps its density.
  [[nodiscard]] float leaf_size() const {
    const auto all = static_cast<float>(tip_count(depth_) * leaves_);
    return std::clamp(22.0F / std::sqrt(all), 0.01F, 0.3F);
  }

  Random random_;
  std::uint64_t depth_;
  std::uint64_t leaves_;
};

}  // namespace

Scene make_tree(const BuiltinOptions& options) {
  options.allow_only({"size", "triangles", "primitives", "seed", "leaves"});
  std::uint64_t depth = options.integer("size", 7, 0, kMaxDepth);
  std::uint64_t leaves = options.integer("leaves", kLeaves, 0, kMaxLeaves);
  if (const std::uint64_t target = options.target(); target > 0) {
    depth = nearest_size(target, 0, kMaxDepth, [&](std::uint64_t d) { return triangle_count(d, leaves); });
    if (!options.has("leaves")) {
      if (depth > 0 && triangle_count(depth, 0) > target) --depth;
      leaves = nearest_size(target, 0, kMaxLeaves, [&](std::uint64_t l) { return triangle_count(depth, l); });
    }
  }
  if (triangle_count(depth, leaves) > kMaxBuiltinPrimitives) options.fail("more than 200000000 triangles; lower size or leaves");

  Grower grower(options.seed(), depth, leaves);
  grower.grow();
  SceneBuilder builder;
  PartMesh ground;
  add_ground(ground, {0.0F, 0.0F, 0.0F}, 60.0F);
  builder.add_mesh("meadow", std::move(ground), builder.add_material(matte({0.16F, 0.2F, 0.07F})));
  builder.add_mesh("wood", std::move(grower.wood), builder.add_material(matte({0.17F, 0.11F, 0.07F})));
  if (!grower.foliage.triangles.empty()) {
    Material green;
    green.name = "leaf";
    green.kind = MaterialKind::diffuse_transmission;
    green.base_colour.value = Vec3(0.1F, 0.24F, 0.035F);
    green.transmission_colour.value = Vec3(0.16F, 0.3F, 0.03F);
    builder.add_mesh("leaves", std::move(grower.foliage), builder.add_material(std::move(green)));
  }
  builder.set_sky({0.17F, 0.36F, 0.82F}, {0.85F, 0.9F, 0.95F}, {0.2F, 0.22F, 0.12F});
  builder.add_sun({-0.6F, -0.65F, -0.35F}, {4.2F, 3.8F, 3.1F});
  return builder.finish(look_at({1.5F, 1.5F, 7.2F}, {0.0F, 1.95F, 0.0F}, {0.0F, 1.0F, 0.0F}, 0.72F));
}

}  // namespace grove
