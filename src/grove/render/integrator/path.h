#pragma once

#include "grove/render/film.h"
#include "grove/render/integrator/path_vertex.h"
#include "grove/render/integrator/ray_tracer.h"

namespace grove {

/// The light that comes along a camera ray, by one path (Kajiya 1986, "The Rendering Equation"), with next-event estimation at every
/// surface weighed against the scattering function's own samples by multiple importance sampling (Veach and Guibas 1995), and Russian
/// roulette from the fourth surface on. Asks the structure about one ray after another; PathBatch finds the same, bit for bit.
[[nodiscard]] Film::Sample trace_path(const PreparedScene& world, const PathSettings& settings, const Ray& camera_ray,
                                      const Sampler& sampler, RayTracer& tracer);

}  // namespace grove
