#include "grove/render/integrator/path.h"

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

// Light that comes straight from a light source and is scattered once, at `point`, towards the viewer.
Vec3 direct_light(const PreparedScene& world, const SurfacePoint& point, const ShadingPoint& shading, const Sampler& sampler,
                  std::uint32_t vertex, RayTracer& tracer) {
  const LightSample light =
      world.lights.sample(shading.receiver(point), sampler.sample_2d(dimension(vertex, VertexDimension::light_choice)),
                          sampler.sample_2d(dimension(vertex, VertexDimension::light_point)));
  if (!(light.pdf > 0.0F)) return Vec3(0.0F);
  const Vec3 wi = shading.frame.to_local(light.direction);
  if (!shading.is_consistent(light.direction, wi)) return Vec3(0.0F);
  const BsdfValue scattered = shading.bsdf.evaluate(shading.wo, wi);
  const float weight = light.is_delta ? 1.0F : power_heuristic(light.pdf, scattered.pdf);
  const Vec3 result = scattered.value * light.radiance * (weight / light.pdf);
  if (is_black(result)) return result;
  return result * tracer.transmittance(point, light);
}

}  // namespace

Film::Sample trace_path(const PreparedScene& world, const PathSettings& settings, const Ray& camera_ray, const Sampler& sampler,
                        RayTracer& tracer) {
  Film::Sample result;
  Vec3 throughput(1.0F);
  float eta_squared = 1.0F;  // undoes the compression of radiance in glass, for the roulette
  Ray ray = camera_ray;
  LightReceiver previous;  // the last vertex
  float pdf = 0.0F;        // of the direction taken there; 0 where no light could have been sampled instead
  SurfaceHit surface;

  for (std::uint32_t vertex = 0;; ++vertex) {
    const bool is_hit = tracer.find_surface(ray, surface);
    const float limit = vertex > 1 ? settings.indirect_clamp : 0.0F;
    if (!is_hit) {
      const EnvironmentLight& sky = world.lights.environment();
      if (!sky.is_on()) break;
      const float weight = pdf > 0.0F ? power_heuristic(pdf, world.lights.pdf_of_environment(previous, ray.direction)) : 1.0F;
      result.radiance += clamped(throughput * sky.radiance(ray.direction) * weight, limit);
      break;
    }
    const SurfacePoint& point = surface.point;
    const Vec3 to_viewer = -ray.direction;
    const Vec3 emitted = world.lights.emitted(point, to_viewer);
    if (!is_black(emitted)) {
      const float weight = pdf > 0.0F ? power_heuristic(pdf, world.lights.pdf_of_hit(previous, surface.hit, point)) : 1.0F;
      result.radiance += clamped(throughput * emitted * weight, limit);
    }
    if (vertex > 0 && vertex >= settings.max_depth) break;

    const ShadingPoint shading(world, point, to_viewer, sampler.sample_1d(dimension(vertex, VertexDimension::material)));
    if (vertex == 0) {
      result.albedo = shading.bsdf.albedo(shading.wo);
      result.normal = shading.frame.z;
      if (settings.max_depth == 0) break;
    }
    if (!shading.bsdf.is_delta()) {
      const Vec3 direct = throughput * direct_light(world, point, shading, sampler, vertex, tracer);
      result.radiance += clamped(direct, vertex > 0 ? settings.indirect_clamp : 0.0F);
    }

    const BsdfSample next = shading.bsdf.sample(shading.wo, sampler.sample_1d(dimension(vertex, VertexDimension::lobe)),
                                                sampler.sample_2d(dimension(vertex, VertexDimension::direction)));
    if (!next || is_black(next.weight)) break;
    const Vec3 direction = glm::normalize(shading.frame.to_world(next.wi));
    if (!shading.is_consistent(direction, next.wi)) break;
    throughput *= next.weight;
    eta_squared *= next.eta_squared;
    pdf = next.is_delta ? 0.0F : next.pdf;
    previous = shading.receiver(point);
    ray = Ray{};
    ray.origin = point.offset_origin(direction);
    ray.direction = direction;

    if (vertex >= kRouletteStart) {
      const float survival = std::min(kMaxSurvival, max_component(throughput) * eta_squared);
      if (sampler.sample_1d(dimension(vertex, VertexDimension::roulette)) >= survival) break;
      throughput /= survival;
    }
  }
  return result;
}

}  // namespace grove
