#pragma once

#include "grove/render/film.h"
#include "grove/render/integrator/ray_tracer.h"

// Integrators that look no further than the first surface. All set the denoiser's guides as the path tracer does.

namespace grove {

/// 1 where a cosine-weighted direction is free for `distance`, else 0; white where there is nothing.
[[nodiscard]] Film::Sample trace_ambient_occlusion(const PreparedScene& world, float distance, const Ray& camera_ray,
                                                   const Sampler& sampler, RayTracer& tracer);

/// The shading normal n on the viewer's side as the colour (n + 1) / 2; black where there is nothing.
[[nodiscard]] Film::Sample trace_normal(const PreparedScene& world, const Ray& camera_ray, const Sampler& sampler, RayTracer& tracer);

/// The distance to the first surface; 0 where there is nothing.
[[nodiscard]] Film::Sample trace_depth(const PreparedScene& world, const Ray& camera_ray, const Sampler& sampler, RayTracer& tracer);

/// Nodes visited, primitives tested, and their sum, of the camera ray alone.
[[nodiscard]] Film::Sample trace_cost(const PreparedScene& world, const Ray& camera_ray);

}  // namespace grove
