#pragma once

#include <cstdint>
#include <vector>

#include "grove/render/integrator/recorded_ray.h"
#include "grove/render/integrator/surface_filters.h"
#include "grove/render/prepared_scene.h"
#include "grove/render/sampling/sampler.h"

namespace grove {

/// Where a ray first met something that it could not pass.
struct SurfaceHit {
  Hit hit;
  Ray ray;
  SurfacePoint point;
};

/// Traces the rays of one camera sample, one after another, through what lets light pass (alpha, interfaces), and counts them. For one thread.
class RayTracer {
 public:
  /// Every ray is appended to `recording` where that is not null; it must outlive the tracer.
  RayTracer(const PreparedScene& world, const Sampler& sampler, std::vector<RecordedRay>* recording = nullptr)
      : world_(&world), sampler_(&sampler), recording_(recording), light_(world) {}

  /// The first surface along `ray` that stops it; a partly transparent one does by chance. False when there is none.
  [[nodiscard]] bool find_surface(const Ray& ray, SurfaceHit& result);

  /// The part of light, in [0, 1], that comes along a ray of finite or infinite length.
  [[nodiscard]] float transmittance(const Ray& ray);

  [[nodiscard]] std::uint64_t rays_traced() const { return rays_traced_; }

 private:
  void count(const Ray& ray, bool asks_any);

  const PreparedScene* world_;
  const Sampler* sampler_;
  std::vector<RecordedRay>* recording_;
  std::uint64_t rays_traced_ = 0;
  std::uint32_t surfaces_ = 0;  // looked for so far
  LightFilter light_;
};

}  // namespace grove
