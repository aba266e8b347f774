#include "grove/lab/workload.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "grove/base/check.h"
#include "grove/base/error.h"
#include "grove/base/parallel.h"
#include "grove/base/random.h"
#include "grove/render/camera_rays.h"
#include "grove/render/surface/surface_table.h"

namespace grove {
namespace {

constexpr std::array kAllKinds{RayKind::primary, RayKind::diffuse, RayKind::shadow, RayKind::random, RayKind::recorded};
constexpr std::size_t kGrain = 4096;

/// Ambient-occlusion segments are this part of the scene's diagonal.
constexpr float kShadowLength = 0.1F;
/// Random rays start in the bounds enlarged by this part of their extent on each side, so that some come from outside.
constexpr float kRandomMargin = 0.1F;

/// The generator of ray i: a pure function of kind, seed and i, so that the order of work plays no part.
Random generator(RayKind kind, std::uint64_t seed, std::size_t i) {
  return Random(mix_bits(seed ^ static_cast<std::uint64_t>(kind) << 56) + i);
}

/// Uniform over the unit sphere: by Archimedes, height and azimuth are uniform.
Vec3 uniform_direction(Random& random) {
  const float z = random.next_float(-1.0F, 1.0F);
  const float azimuth = 2.0F * kPi * random.next_float();
  const float radius = std::sqrt(std::max(0.0F, 1.0F - z * z));
  return {radius * std::cos(azimuth), radius * std::sin(azimuth), z};
}

/// Cosine-distributed about `normal`: normal plus a uniform direction, normalised.
Vec3 cosine_direction(const Vec3& normal, Random& random) {
  const Vec3 sum = normal + uniform_direction(random);
  const float length = glm::length(sum);
  return length > 1e-6F ? sum / length : normal;
}

float diagonal_of(const Box& bounds) {
  // In double: the squares of large coordinates overflow a float.
  return bounds.is_empty() ? 0.0F : static_cast<float>(glm::length(glm::dvec3(bounds.upper) - glm::dvec3(bounds.lower)));
}

std::vector<Ray> primary_rays(const Camera& camera, const WorkloadSettings& settings) {
  // A square picture with pixels enough for all rays.
  const std::size_t pixels = (settings.ray_count + settings.samples_per_pixel - 1) / settings.samples_per_pixel;
  const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(pixels))));
  Camera pinhole = camera;
  pinhole.lens_radius = 0.0F;
  const CameraRays camera_rays(pinhole, static_cast<std::uint32_t>(side), static_cast<std::uint32_t>(side));
  std::vector<Ray> rays(settings.ray_count);
  parallel_for(rays.size(), kGrain, [&](std::size_t i) {
    Random random = generator(RayKind::primary, settings.seed, i);
    const std::size_t pixel = i / settings.samples_per_pixel;
    const std::size_t row = pixel / side;
    const std::size_t column = pixel % side;
    const float x = static_cast<float>(column) + random.next_float();
    const float y = static_cast<float>(row) + random.next_float();
    rays[i] = camera_rays.ray({x, y}, {0.5F, 0.5F});
  });
  return rays;
}

std::vector<Ray> random_rays(const Box& bounds, const WorkloadSettings& settings) {
  const Vec3 margin = kRandomMargin * bounds.extent();
  const Vec3 lower = bounds.lower - margin;
  const Vec3 upper = bounds.upper + margin;
  std::vector<Ray> rays(settings.ray_count);
  parallel_for(rays.size(), kGrain, [&](std::size_t i) {
    Random random = generator(RayKind::random, settings.seed, i);
    for (int axis = 0; axis < 3; ++axis) rays[i].origin[axis] = random.next_float(lower[axis], upper[axis]);
    rays[i].direction = uniform_direction(random);
  });
  return rays;
}

/// The points where `rays` meet the scene, in the order of the rays, with their geometric normals on the side that the ray came from.
std::vector<SurfacePoint> points_met(const Scene& scene, const Accelerator& accelerator, std::span<const Ray> rays) {
  std::vector<Hit> hits(rays.size());
  trace(accelerator, Query::closest, rays, hits);
  const SurfaceTable surfaces(scene);
  std::vector<SurfacePoint> points;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!hits[i]) continue;
    SurfacePoint point = surfaces.at(rays[i], hits[i]);
    if (glm::dot(point.geometric_normal, rays[i].direction) > 0.0F) point.geometric_normal = -point.geometric_normal;
    // A surface too small to have a normal is left out.
    if (std::isfinite(glm::dot(point.geometric_normal, point.position))) points.push_back(point);
  }
  return points;
}

std::vector<Ray> surface_rays(RayKind kind, std::span<const SurfacePoint> points, float diagonal, const WorkloadSettings& settings) {
  std::vector<Ray> rays(settings.ray_count);
  parallel_for(rays.size(), kGrain, [&](std::size_t i) {
    Random random = generator(kind, settings.seed, i);
    // Where points are fewer than rays, each serves several.
    const SurfacePoint& point = points[i % points.size()];
    rays[i].direction = cosine_direction(point.geometric_normal, random);
    rays[i].origin = point.offset_origin(rays[i].direction);
    if (kind == RayKind::shadow) rays[i].t_max = kShadowLength * diagonal;
  });
  return rays;
}

}  // namespace

std::span<const RayKind> ray_kinds() {
  return std::span(kAllKinds).first(kAllKinds.size() - 1);
}

std::span<const RayKind> all_ray_kinds() {
  return kAllKinds;
}

std::string_view name_of(RayKind kind) {
  switch (kind) {
    case RayKind::primary:
      return "primary";
    case RayKind::diffuse:
      return "diffuse";
    case RayKind::shadow:
      return "shadow";
    case RayKind::random:
      return "random";
    case RayKind::recorded:
      return "recorded";
  }
  return "";
}

RayKind parse_ray_kind(std::string_view name, std::span<const RayKind> allowed) {
  std::string known;
  for (const RayKind kind : allowed) {
    if (name == name_of(kind)) return kind;
    known += (known.empty() ? "" : ", ") + std::string(name_of(kind));
  }
  throw UsageError("unknown kind of rays '" + std::string(name) + "'; the kinds are " + known);
}

Query query_of(RayKind kind) {
  return kind == RayKind::shadow ? Query::any : Query::closest;
}

Camera workload_camera(const Scene& scene, std::string_view name) {
  if (name.empty()) return scene.cameras.empty() ? frame_bounds(scene.bounds(), 1.0F) : scene.cameras.front();
  std::string known;
  for (const Camera& camera : scene.cameras) {
    if (camera.name == name) return camera;
    known += (known.empty() ? "" : ", ") + camera.name;
  }
  throw UsageError("no camera '" + std::string(name) + "' in the scene; " + (known.empty() ? "it has none" : "it has " + known));
}

std::vector<Ray> make_rays(RayKind kind, const Scene& scene, const SceneAccelerator& accelerator, const Camera& camera,
                           const WorkloadSettings& settings) {
  GROVE_CHECK(kind != RayKind::recorded);
  const Box bounds = accelerator.top().bounds();
  if (kind == RayKind::primary) return primary_rays(camera, settings);
  if (kind == RayKind::random) return random_rays(bounds, settings);
  std::vector<SurfacePoint> points = points_met(scene, accelerator.top(), primary_rays(camera, settings));
  if (points.empty()) points = points_met(scene, accelerator.top(), random_rays(bounds, settings));
  if (points.empty()) throw InputError(scene.name, "", "no ray meets the scene, so there are no " + std::string(name_of(kind)) + " rays");
  return surface_rays(kind, points, diagonal_of(bounds), settings);
}

}  // namespace grove
