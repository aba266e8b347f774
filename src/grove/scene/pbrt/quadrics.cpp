// pbrt's quadrics as triangles; whole round spheres stay analytic.

#include <algorithm>
#include <cmath>

#include <glm/mat3x3.hpp>

#include "grove/scene/pbrt/shapes.h"

namespace grove::pbrt {
namespace {

/// The turn of phi from 0 to `phimax`.
class Sweep {
 public:
  Sweep(const ParameterList& parameters, std::uint32_t steps)
      : degrees_(std::clamp(parameters.number("phimax", 360.0F), 0.0F, 360.0F)), steps_(steps) {}

  [[nodiscard]] std::uint32_t steps() const { return steps_; }
  [[nodiscard]] bool is_whole() const { return degrees_ == 360.0F; }
  [[nodiscard]] float fraction(std::uint32_t i) const { return static_cast<float>(i) / static_cast<float>(steps_); }
  /// Cosine and sine at step i; where the sweep closes, the last step is exactly the first, so that no seam opens.
  [[nodiscard]] Vec2 direction(std::uint32_t i) const {
    const std::uint32_t step = is_whole() ? i % steps_ : i;
    const float phi = degrees_ * (kPi / 180.0F) * static_cast<float>(step) / static_cast<float>(steps_);
    return {std::cos(phi), std::sin(phi)};
  }

 private:
  float degrees_;
  std::uint32_t steps_;
};

float positive_radius(const ParameterList& parameters) {
  const float radius = parameters.number("radius", 1.0F);
  if (!(radius > 0.0F)) parameters.place().fail("\"radius\" must be positive");
  return radius;
}

struct SphereExtent {
  float radius, z_min, z_max;
};

SphereExtent sphere_extent(const ParameterList& parameters) {
  const float radius = positive_radius(parameters);
  const float a = parameters.number("zmin", -radius);
  const float b = parameters.number("zmax", radius);
  return {radius, std::clamp(std::min(a, b), -radius, radius), std::clamp(std::max(a, b), -radius, radius)};
}

}  // namespace

std::optional<SphereSet::Sphere> analytic_sphere(const ParameterList& parameters, const Matrix& to_target) {
  const SphereExtent extent = sphere_extent(parameters);
  if (!Sweep(parameters, 1).is_whole() || extent.z_min > -extent.radius || extent.z_max < extent.radius) return std::nullopt;
  // Round means: the columns are of one length and at right angles, up to the rounding of the numbers in the file.
  constexpr double kTolerance = 1e-5;
  const glm::dmat3 linear(to_target);
  const double scale_squared = glm::dot(linear[0], linear[0]);
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      const double expected = i == j ? scale_squared : 0.0;
      if (!(std::abs(glm::dot(linear[i], linear[j]) - expected) <= kTolerance * scale_squared)) return std::nullopt;
    }
  }
  return SphereSet::Sphere{transform_point(to_target, Vec3(0.0F)), static_cast<float>(extent.radius * std::sqrt(scale_squared))};
}

ShapeMesh make_sphere(const ParameterList& parameters, const Context& context) {
  const auto [radius, z_min, z_max] = sphere_extent(parameters);
  const Sweep sweep(parameters, context.quadric_steps);
  const float theta_min = std::acos(z_min / radius);
  const float theta_max = std::acos(z_max / radius);
  ShapeMesh mesh;
  append_grid(mesh, sweep.steps(), sweep.steps() / 2, [&, radius = radius](std::uint32_t i, std::uint32_t j) {
    const Vec2 uv(sweep.fraction(i), 2.0F * sweep.fraction(j));
    const float theta = theta_min + uv.y * (theta_max - theta_min);
    // The sine of a rounded pi is not quite 0; the pole must be one point.
    const float sine = std::abs(std::sin(theta)) < 1e-6F ? 0.0F : std::sin(theta);
    const Vec2 around = sweep.direction(i);
    const Vec3 normal(sine * around.x, sine * around.y, std::cos(theta));
    return SurfacePoint{radius * normal, normal, uv};
  });
  return mesh;
}

ShapeMesh make_disk(const ParameterList& parameters, const Context& context) {
  const float radius = positive_radius(parameters);
  const float inner = std::clamp(parameters.number("innerradius", 0.0F), 0.0F, radius);
  const float height = parameters.number("height", 0.0F);
  const Sweep sweep(parameters, context.quadric_steps);
  ShapeMesh mesh;
  // v runs from the rim inward.
  append_grid(mesh, sweep.steps(), 1, [&](std::uint32_t i, std::uint32_t j) {
    const float r = j == 0 ? radius : inner;
    const Vec2 around = sweep.direction(i);
    return SurfacePoint{{r * around.x, r * around.y, height}, {0.0F, 0.0F, 1.0F}, {sweep.fraction(i), static_cast<float>(j)}};
  });
  return mesh;
}

ShapeMesh make_cylinder(const ParameterList& parameters, const Context& context) {
  const float radius = positive_radius(parameters);
  const float a = parameters.number("zmin", -1.0F);
  const float b = parameters.number("zmax", 1.0F);
  const Sweep sweep(parameters, context.quadric_steps);
  ShapeMesh mesh;
  append_grid(mesh, sweep.steps(), 1, [&](std::uint32_t i, std::uint32_t j) {
    const Vec2 around = sweep.direction(i);
    return SurfacePoint{{radius * around.x, radius * around.y, j == 0 ? std::min(a, b) : std::max(a, b)},
                        {around.x, around.y, 0.0F},
                        {sweep.fraction(i), static_cast<float>(j)}};
  });
  return mesh;
}

}  // namespace grove::pbrt
