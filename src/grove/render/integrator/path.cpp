#include "grove/render/integrator/path.h"

namespace grove {

Film::Sample trace_path(const PreparedScene& world, const PathSettings& settings, const Ray& camera_ray, const Sampler& sampler,
                        RayTracer& tracer) {
  Film::Sample result;
  PathState path(sampler);
  Ray ray = camera_ray;
  SurfaceHit surface;
  ShadowRay shadow;
  for (std::uint32_t vertex = 0;; ++vertex) {
    if (!tracer.find_surface(ray, surface)) {
      add_sky(world, settings, vertex, ray, path, result);
      return result;
    }
    const VertexStep step = shade_vertex(world, settings, vertex, surface.hit, surface.point, ray, path, result, shadow);
    if (step.has_shadow_ray) add_light(settings, vertex, shadow.radiance, tracer.transmittance(shadow.ray), result);
    if (!step.goes_on) return result;
  }
}

}  // namespace grove
