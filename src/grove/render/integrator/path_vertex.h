#pragma once

#include <cstdint>

#include "grove/render/film.h"
#include "grove/render/prepared_scene.h"
#include "grove/render/sampling/sampler.h"

// What happens to a path at its vertices. Which rays are traced together is for others to decide (path.h, path_batch.h): a path asks for a ray to its next
// vertex and, now and then, for one to a light, and the answers to these two decide all the rest.

namespace grove {

struct PathSettings {
  std::uint32_t max_depth = 8;
  float indirect_clamp = 0.0F;
};

/// What a path carries from one vertex to the next, beside its ray.
struct PathState {
  explicit PathState(const Sampler& path_sampler, std::uint32_t path_id = 0) : sampler(path_sampler), id(path_id) {}

  Sampler sampler;
  Vec3 throughput{1.0F};
  float eta_squared = 1.0F;         ///< undoes the compression of radiance in glass, for the roulette
  LightReceiver previous;           ///< the last vertex
  float pdf = 0.0F;                 ///< of the direction taken there; 0 where no light could have been sampled instead
  std::uint32_t chances_taken = 0;  ///< of passing partly transparent surfaces
  std::uint32_t id;                 ///< among those that are traced together
};

static_assert(sizeof(PathState) == 72, "batches of paths are to stay in the second-level cache");

/// Light on its way to a vertex. It arrives as far as the ray is free.
struct ShadowRay {
  Ray ray;
  Vec3 radiance{0.0F};  ///< what the whole path brings to the camera when it is
};

/// What a path asks for after a vertex.
struct VertexStep {
  bool has_shadow_ray = false;
  bool goes_on = false;
};

/// Adds what a path sees that has left the scene along `ray`, behind `vertex` surfaces.
void add_sky(const PreparedScene& world, const PathSettings& settings, std::uint32_t vertex, const Ray& ray, const PathState& path,
             Film::Sample& sample);

/// Adds the light that the surface itself sends along `ray`, which met it at `point`, scatters, and chooses how to go on: then `ray` and `path` are those
/// that leave the surface. `vertex` counts surfaces from 0. `shadow` is set where the step says so.
[[nodiscard]] VertexStep shade_vertex(const PreparedScene& world, const PathSettings& settings, std::uint32_t vertex, const Hit& hit,
                                      const SurfacePoint& point, Ray& ray, PathState& path, Film::Sample& sample, ShadowRay& shadow);

/// Adds what a shadow ray's light brings when this part of it, in [0, 1], arrives at the vertex.
void add_light(const PathSettings& settings, std::uint32_t vertex, const Vec3& radiance, float transmittance, Film::Sample& sample);

}  // namespace grove
