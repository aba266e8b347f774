#pragma once

#include "grove/render/camera_rays.h"
#include "grove/render/integrator/dimensions.h"
#include "grove/render/sampling/sampler.h"
#include "grove/render/sampling/warp.h"

namespace grove {

/// The camera ray of one sample of pixel (x, y). The reconstruction filter is a tent two pixels wide, by importance sampling (Ernst, Stamminger, Greiner
/// 2006, "Filter Importance Sampling"): each sample then belongs to one pixel alone.
[[nodiscard]] inline Ray film_ray(const CameraRays& camera, std::uint32_t x, std::uint32_t y, const Sampler& sampler) {
  const Vec2 u = sampler.sample_2d(kFilmDimension);
  const Vec2 place(static_cast<float>(x) + 0.5F + sample_tent(u.x), static_cast<float>(y) + 0.5F + sample_tent(u.y));
  return camera.ray(place, camera.has_lens() ? sampler.sample_2d(kLensDimension) : Vec2(0.5F));
}

}  // namespace grove
