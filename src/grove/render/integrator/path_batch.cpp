#include "grove/render/integrator/path_batch.h"

#include <algorithm>

#include "grove/base/check.h"

namespace grove {

void PathBatch::trace(std::span<Ray> camera_rays, std::span<const Sampler> samplers, std::span<Film::Sample> samples) {
  GROVE_CHECK(camera_rays.size() == samplers.size() && camera_rays.size() == samples.size());
  std::ranges::fill(samples, Film::Sample{});
  paths_.clear();
  paths_.reserve(samplers.size());
  for (const Sampler& sampler : samplers) paths_.emplace_back(sampler, static_cast<std::uint32_t>(paths_.size()));
  hits_.resize(samplers.size());
  std::span<Ray> rays = camera_rays;
  for (std::uint32_t vertex = 0; !rays.empty(); ++vertex) {
    tracer_.find_surfaces(rays, std::span(hits_).first(rays.size()), paths_);
    const std::size_t left = shade(vertex, rays, samples);
    transmittances_.resize(shadow_rays_.size());
    if (!shadow_rays_.empty()) tracer_.find_light(shadow_rays_, transmittances_);
    for (std::size_t i = 0; i < light_.size(); ++i)
      add_light(settings_, vertex, light_[i].radiance, transmittances_[i], samples[light_[i].path]);
    rays = rays.first(left);
    paths_.erase(paths_.begin() + static_cast<std::ptrdiff_t>(left), paths_.end());
  }
}

std::size_t PathBatch::shade(std::uint32_t vertex, std::span<Ray> rays, std::span<Film::Sample> samples) {
  shadow_rays_.clear();
  light_.clear();
  std::size_t left = 0;
  ShadowRay shadow;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    PathState& path = paths_[i];
    Film::Sample& sample = samples[path.id];
    if (!hits_[i]) {
      add_sky(*world_, settings_, vertex, rays[i], path, sample);
      continue;
    }
    const SurfacePoint point = world_->surfaces.at(rays[i], hits_[i]);
    const VertexStep step = shade_vertex(*world_, settings_, vertex, hits_[i], point, rays[i], path, sample, shadow);
    if (step.has_shadow_ray) {
      shadow_rays_.push_back(shadow.ray);
      light_.push_back({shadow.radiance, path.id});
    }
    if (!step.goes_on) continue;
    rays[left] = rays[i];
    paths_[left] = path;
    ++left;
  }
  return left;
}

}  // namespace grove
