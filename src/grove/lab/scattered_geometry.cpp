#include "grove/lab/scattered_geometry.h"

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

}  // namespace

std::string_view name_of(ScatteredPrimitive primitive) {
  return primitive == ScatteredPrimitive::spheres ? "spheres" : "triangles";
}

GeometryPointer scatter(const ScatterSettings& settings) {
  constexpr double kFilled = 0.01;
  const double volume = kFilled / static_cast<double>(settings.count);
  const auto radius = static_cast<float>(std::cbrt(volume * 3.0 / (4.0 * std::numbers::pi)));
  Random random(settings.seed);
  const auto centre = [&] {
    const Vec3 u = random_point(random);
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = static_cast<float>(std::pow(static_cast<double>(u[axis]), settings.skew));
    return p;
  };
  if (settings.primitive == ScatteredPrimitive::spheres) {
    std::vector<SphereSet::Sphere> spheres;
    spheres.reserve(settings.count);
    for (std::size_t i = 0; i < settings.count; ++i) spheres.push_back({centre(), radius});
    return std::make_shared<const SphereSet>(std::move(spheres));
  }
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  vertices.reserve(3 * settings.count);
  triangles.reserve(settings.count);
  for (std::uint32_t i = 0; i < settings.count; ++i) {
    const Vec3 at = centre();
    const Vec3 first = random_direction(random);
    const Vec3 second = random_direction(random);
    vertices.insert(vertices.end(), {at, at + 2.0F * radius * first, at + 2.0F * radius * second});
    triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
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

}  // namespace grove
