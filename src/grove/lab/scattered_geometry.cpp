#include "grove/lab/scattered_geometry.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "grove/base/random.h"

namespace grove {
namespace {

Vec3 random_point(Random& random) {
  const float x = random.next_float();
  const float y = random.next_float();
  return {x, y, random.next_float()};
}

// Uniform over the sphere (Archimedes).
Vec3 random_direction(Random& random) {
  const double z = 1.0 - 2.0 * static_cast<double>(random.next_float());
  const double azimuth = 2.0 * std::numbers::pi * static_cast<double>(random.next_float());
  const double across = std::sqrt(std::fmax(0.0, 1.0 - z * z));
  return Vec3(glm::dvec3(across * std::cos(azimuth), across * std::sin(azimuth), z));
}

// Centres are drawn one after the other.
class Scatter {
 public:
  explicit Scatter(const ScatterSettings& settings) : random(settings.seed), skew_(settings.skew) {
    constexpr double kFilled = 0.01;
    const double volume = kFilled / static_cast<double>(settings.count);
    radius = static_cast<float>(std::cbrt(volume * 3.0 / (4.0 * std::numbers::pi)));
  }
  Vec3 next_centre() {
    const Vec3 u = random_point(random);
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = static_cast<float>(std::pow(static_cast<double>(u[axis]), skew_));
    return p;
  }

  Random random;
  float radius;

 private:
  double skew_;
};

std::vector<SphereSet::Sphere> scatter_spheres(const ScatterSettings& settings) {
  Scatter scatter(settings);
  std::vector<SphereSet::Sphere> spheres;
  spheres.reserve(settings.count);
  for (std::size_t i = 0; i < settings.count; ++i) spheres.push_back({scatter.next_centre(), scatter.radius});
  return spheres;
}

// Three corners each.
std::vector<Vec3> scatter_triangles(const ScatterSettings& settings) {
  Scatter scatter(settings);
  std::vector<Vec3> corners;
  corners.reserve(3 * settings.count);
  for (std::size_t i = 0; i < settings.count; ++i) {
    const Vec3 at = scatter.next_centre();
    const Vec3 first = random_direction(scatter.random);
    const Vec3 second = random_direction(scatter.random);
    corners.insert(corners.end(), {at, at + 2.0F * scatter.radius * first, at + 2.0F * scatter.radius * second});
  }
  return corners;
}

GeometryPointer make_mesh(std::vector<Vec3> corners) {
  std::vector<Triangle> triangles(corners.size() / 3);
  for (std::uint32_t i = 0; i < triangles.size(); ++i) triangles[i] = {3 * i, 3 * i + 1, 3 * i + 2};
  return std::make_shared<const TriangleMesh>(std::move(corners), std::move(triangles));
}

}  // namespace

std::string_view name_of(ScatteredPrimitive primitive) {
  return primitive == ScatteredPrimitive::spheres ? "spheres" : "triangles";
}

GeometryPointer scatter(const ScatterSettings& settings) {
  if (settings.primitive == ScatteredPrimitive::spheres) return std::make_shared<const SphereSet>(scatter_spheres(settings));
  return make_mesh(scatter_triangles(settings));
}

GeometryPointer scatter_again(const ScatterSettings& settings, std::size_t stride, std::uint64_t seed, std::vector<std::uint32_t>& moved) {
  ScatterSettings elsewhere = settings;
  elsewhere.seed = seed;
  moved.clear();
  for (std::size_t i = 0; i < settings.count; i += stride) moved.push_back(static_cast<std::uint32_t>(i));
  if (settings.primitive == ScatteredPrimitive::spheres) {
    std::vector<SphereSet::Sphere> spheres = scatter_spheres(settings);
    const std::vector<SphereSet::Sphere> others = scatter_spheres(elsewhere);
    for (const std::uint32_t i : moved) spheres[i] = others[i];
    return std::make_shared<const SphereSet>(std::move(spheres));
  }
  std::vector<Vec3> corners = scatter_triangles(settings);
  const std::vector<Vec3> others = scatter_triangles(elsewhere);
  for (const std::uint32_t i : moved) std::copy_n(others.begin() + 3 * i, 3, corners.begin() + 3 * i);
  return make_mesh(std::move(corners));
}

std::vector<Ray> rays_inside(const Box& box, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Ray> rays;
  rays.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 origin = box.lower + box.extent() * random_point(random);
    rays.push_back({origin, 0.0F, random_direction(random)});
  }
  return rays;
}

std::vector<Ray> lines_through(const Box& box, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  const glm::dvec3 lower(box.lower);
  const glm::dvec3 upper(box.upper);
  const double radius = 0.5 * glm::length(upper - lower);
  std::vector<Ray> rays;
  rays.reserve(count);
  while (rays.size() < count) {
    // Lines of one direction are uniform over a disk across it that covers the box.
    const glm::dvec3 direction(random_direction(random));
    const glm::dvec3 aside = std::fabs(direction.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 u = glm::normalize(glm::cross(direction, aside));
    const glm::dvec3 v = glm::cross(direction, u);
    const double r = radius * std::sqrt(static_cast<double>(random.next_float()));
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(random.next_float());
    const glm::dvec3 on_disk = 0.5 * (lower + upper) + r * (std::cos(angle) * u + std::sin(angle) * v);
    const Ray ray{Vec3(on_disk - 2.0 * radius * direction), 0.0F, Vec3(direction)};
    double first = 0.0;
    double last = 4.0 * radius;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = (lower[axis] - ray.origin[axis]) / ray.direction[axis];
      const double b = (upper[axis] - ray.origin[axis]) / ray.direction[axis];
      first = std::fmax(first, std::fmin(a, b));
      last = std::fmin(last, std::fmax(a, b));
    }
    if (first <= last) rays.push_back(ray);
  }
  return rays;
}

}  // namespace grove
