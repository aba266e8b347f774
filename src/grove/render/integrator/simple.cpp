#include "grove/render/integrator/simple.h"

#include "grove/render/integrator/dimensions.h"
#include "grove/render/integrator/shading_point.h"
#include "grove/render/sampling/warp.h"

namespace grove {
namespace {

// The first surface as seen along the ray, with the guides filled in.
Film::Sample with_guides(const ShadingPoint& shading) {
  return {.radiance = Vec3(0.0F), .albedo = shading.bsdf.albedo(shading.wo), .normal = shading.frame.z};
}

ShadingPoint shade(const PreparedScene& world, const SurfaceHit& surface, const Sampler& sampler) {
  return {world, surface.point, -surface.ray.direction, sampler.sample_1d(dimension(0, VertexDimension::material))};
}

}  // namespace

Film::Sample trace_ambient_occlusion(const PreparedScene& world, float distance, const Ray& camera_ray, const Sampler& sampler,
                                     RayTracer& tracer) {
  SurfaceHit surface;
  if (!tracer.find_surface(camera_ray, surface)) return {.radiance = Vec3(1.0F)};
  const ShadingPoint shading = shade(world, surface, sampler);
  Film::Sample result = with_guides(shading);
  const Vec3 local = sample_cosine_hemisphere(sampler.sample_2d(dimension(0, VertexDimension::direction)));
  Ray ray;
  ray.direction = glm::normalize(shading.frame.to_world(local));
  if (!shading.is_consistent(ray.direction, local)) return result;
  ray.origin = surface.point.offset_origin(ray.direction);
  ray.t_max = distance;
  result.radiance = Vec3(tracer.transmittance(ray));
  return result;
}

Film::Sample trace_normal(const PreparedScene& world, const Ray& camera_ray, const Sampler& sampler, RayTracer& tracer) {
  SurfaceHit surface;
  if (!tracer.find_surface(camera_ray, surface)) return {};
  Film::Sample result = with_guides(shade(world, surface, sampler));
  result.radiance = glm::max(0.5F * result.normal + Vec3(0.5F), Vec3(0.0F));
  return result;
}

Film::Sample trace_depth(const PreparedScene& world, const Ray& camera_ray, const Sampler& sampler, RayTracer& tracer) {
  SurfaceHit surface;
  if (!tracer.find_surface(camera_ray, surface)) return {};
  Film::Sample result = with_guides(shade(world, surface, sampler));
  result.radiance = Vec3(glm::length(surface.point.position - camera_ray.origin));
  return result;
}

Film::Sample trace_cost(const PreparedScene& world, const Ray& camera_ray) {
  TraversalCounts counts;
  (void)world.accelerator.closest_hit(camera_ray, &counts);
  const auto nodes = static_cast<float>(counts.nodes_visited);
  const auto tests = static_cast<float>(counts.primitives_tested);
  return {.radiance = Vec3(nodes, tests, nodes + tests)};
}

}  // namespace grove
