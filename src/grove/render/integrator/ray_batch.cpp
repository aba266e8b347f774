#include "grove/render/integrator/ray_batch.h"

#include <numeric>

namespace grove {

void RayBatch::closest_hits(std::span<const Ray> rays, std::span<Hit> hits) {
  rays_traced_ += rays.size();
  world_->accelerator.intersect(rays, hits);
}

void RayBatch::find_surfaces(std::span<Ray> rays, std::span<Hit> hits, std::span<PathState> paths) {
  closest_hits(rays, hits);
  if (!world_->materials.any_can_pass_light()) return;
  const auto passes = [&](std::uint32_t i) {
    return hits[i] && !stops_ray(*world_, hits[i], paths[i].sampler, paths[i].chances_taken, rays[i]);
  };
  std::vector<std::uint32_t>& ids = pending_.ids;
  ids.clear();
  for (std::uint32_t i = 0; i < rays.size(); ++i)
    if (passes(i)) ids.push_back(i);
  for (int passage = 1; passage < kMostPassages && !ids.empty(); ++passage) {
    pending_.rays.clear();
    for (const std::uint32_t i : ids) pending_.rays.push_back(rays[i]);
    pending_.hits.resize(ids.size());
    closest_hits(pending_.rays, pending_.hits);
    for (std::size_t k = 0; k < ids.size(); ++k) hits[ids[k]] = pending_.hits[k];
    std::erase_if(ids, [&](std::uint32_t i) { return !passes(i); });
  }
  for (const std::uint32_t i : ids) hits[i] = Hit{};
}

void RayBatch::any_hits(std::span<const Ray> rays, std::span<float> transmittances) {
  rays_traced_ += rays.size();
  occluded_.resize(rays.size());
  world_->accelerator.occluded(rays, occluded_);
  for (std::size_t i = 0; i < rays.size(); ++i) transmittances[i] = occluded_[i] != 0 ? 0.0F : 1.0F;
}

void RayBatch::find_light(std::span<Ray> rays, std::span<float> transmittances) {
  if (!world_->materials.any_can_pass_light()) {
    any_hits(rays, transmittances);
    return;
  }
  light_.clear();
  for (const Ray& ray : rays) light_.emplace_back(ray);
  std::vector<std::uint32_t>& ids = pending_.ids;
  ids.resize(rays.size());
  std::iota(ids.begin(), ids.end(), 0U);
  for (int passage = 0; passage < kMostPassages && !ids.empty(); ++passage) {
    pending_.hits.resize(ids.size());
    closest_hits(rays.first(ids.size()), pending_.hits);
    // Those that go on take the first places.
    std::size_t left = 0;
    for (std::size_t k = 0; k < ids.size(); ++k) {
      const std::uint32_t i = ids[k];
      if (light_[i].pass(*world_, pending_.hits[k], rays[k])) {
        rays[left] = rays[k];
        ids[left++] = i;
      } else {
        transmittances[i] = light_[i].transmittance();
      }
    }
    ids.resize(left);
  }
  for (const std::uint32_t i : ids) transmittances[i] = 0.0F;
}

}  // namespace grove
