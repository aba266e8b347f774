#include "grove/render/integrator/path_vertex.h"

#include <algorithm>

#include "grove/render/integrator/dimensions.h"
#include "grove/render/integrator/shading_point.h"
#include "grove/render/sampling/warp.h"

namespace grove {
namespace {

constexpr std::uint32_t kRouletteStart = 3;
constexpr float kMaxSurvival = 0.97F;

bool is_black(const Vec3& colour) {
  return colour.x == 0.0F && colour.y == 0.0F && colour.z == 0.0F;
}

Vec3 clamped(const Vec3& colour, float limit) {
  const float largest = max_component(colour);
  return limit > 0.0F && largest > limit ? colour * (limit / largest) : colour;
}

// From a surface to where the light comes from.
Ray ray_to_light(const SurfacePoint& point, const LightSample& light) {
  Ray ray;
  ray.origin = point.offset_origin(light.direction);
  ray.direction = light.direction;
  if (!light.is_infinite) {
    // Both ends are moved off their surfaces, so that the whole segment counts.
    ray.direction = light.target - ray.origin;
    ray.t_max = 1.0F;
  }
  return ray;
}

// Light that comes straight from a light source and is scattered once, at `point`, towards the viewer. False where there is none.
bool sample_light(const PreparedScene& world, const SurfacePoint& point, const ShadingPoint& shading, std::uint32_t vertex,
                  const PathState& path, ShadowRay& shadow) {
  const LightSample light =
      world.lights.sample(shading.receiver(point), path.sampler.sample_2d(dimension(vertex, VertexDimension::light_choice)),
                          path.sampler.sample_2d(dimension(vertex, VertexDimension::light_point)));
  if (!(light.pdf > 0.0F)) return false;
  const Vec3 wi = shading.frame.to_local(light.direction);
  if (!shading.is_consistent(light.direction, wi)) return false;
  const BsdfValue scattered = shading.bsdf.evaluate(shading.wo, wi);
  const float weight = light.is_delta ? 1.0F : power_heuristic(light.pdf, scattered.pdf);
  const Vec3 arriving = scattered.value * light.radiance * (weight / light.pdf);
  if (is_black(arriving)) return false;
  shadow.radiance = path.throughput * arriving;
  shadow.ray = ray_to_light(point, light);
  return true;
}

// Chooses the direction in which the path leaves. False where it ends.
bool scatter(const ShadingPoint& shading, const SurfacePoint& point, std::uint32_t vertex, Ray& ray, PathState& path) {
  const Sampler& sampler = path.sampler;
  const BsdfSample next = shading.bsdf.sample(shading.wo, sampler.sample_1d(dimension(vertex, VertexDimension::lobe)),
                                              sampler.sample_2d(dimension(vertex, VertexDimension::direction)));
  if (!next || is_black(next.weight)) return false;
  const Vec3 direction = glm::normalize(shading.frame.to_world(next.wi));
  if (!shading.is_consistent(direction, next.wi)) return false;
  path.throughput *= next.weight;
  path.eta_squared *= next.eta_squared;
  path.pdf = next.is_delta ? 0.0F : next.pdf;
  path.previous = shading.receiver(point);
  ray = Ray{};
  ray.origin = point.offset_origin(direction);
  ray.direction = direction;

  if (vertex < kRouletteStart) return true;
  const float survival = std::min(kMaxSurvival, max_component(path.throughput) * path.eta_squared);
  if (sampler.sample_1d(dimension(vertex, VertexDimension::roulette)) >= survival) return false;
  path.throughput /= survival;
  return true;
}

}  // namespace

void add_sky(const PreparedScene& world, const PathSettings& settings, std::uint32_t vertex, const Ray& ray, const PathState& path,
             Film::Sample& sample) {
  const EnvironmentLight& sky = world.lights.environment();
  if (!sky.is_on()) return;
  const float weight = path.pdf > 0.0F ? power_heuristic(path.pdf, world.lights.pdf_of_environment(path.previous, ray.direction)) : 1.0F;
  sample.radiance += clamped(path.throughput * sky.radiance(ray.direction) * weight, vertex > 1 ? settings.indirect_clamp : 0.0F);
}

VertexStep shade_vertex(const PreparedScene& world, const PathSettings& settings, std::uint32_t vertex, const Hit& hit,
                        const SurfacePoint& point, Ray& ray, PathState& path, Film::Sample& sample, ShadowRay& shadow) {
  const Vec3 to_viewer = -ray.direction;
  const Vec3 emitted = world.lights.emitted(point, to_viewer);
  if (!is_black(emitted)) {
    const float weight = path.pdf > 0.0F ? power_heuristic(path.pdf, world.lights.pdf_of_hit(path.previous, hit, point)) : 1.0F;
    sample.radiance += clamped(path.throughput * emitted * weight, vertex > 1 ? settings.indirect_clamp : 0.0F);
  }
  if (vertex > 0 && vertex >= settings.max_depth) return {};

  const ShadingPoint shading(world, point, to_viewer, path.sampler.sample_1d(dimension(vertex, VertexDimension::material)));
  if (vertex == 0) {
    sample.albedo = shading.bsdf.albedo(shading.wo);
    sample.normal = shading.frame.z;
    if (settings.max_depth == 0) return {};
  }
  VertexStep step;
  step.has_shadow_ray = !shading.bsdf.is_delta() && sample_light(world, point, shading, vertex, path, shadow);
  step.goes_on = scatter(shading, point, vertex, ray, path);
  return step;
}

void add_light(const PathSettings& settings, std::uint32_t vertex, const Vec3& radiance, float transmittance, Film::Sample& sample) {
  if (!(transmittance > 0.0F)) return;
  sample.radiance += clamped(radiance * transmittance, vertex > 0 ? settings.indirect_clamp : 0.0F);
}

}  // namespace grove
