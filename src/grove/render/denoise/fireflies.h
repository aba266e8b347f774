#pragma once

#include <span>

#include "grove/render/denoise/noise_estimate.h"

namespace grove {

/// Takes pixels that are brighter than all of the same surface within 7 x 7 down to the brightest of these, and their measured noise with them, unless their own samples bear them out: a single
/// very bright sample has a standard deviation of its own brightness, whereas a true highlight is many of them brighter than its neighbours. So with more and more samples
/// nothing is taken down. On a surface so thin that fewer than four of its pixels are near, all surfaces there are looked at instead, and half as many deviations bear a pixel out. Light is
/// lost where noise is strong, which `keep_brightness` gives back to the area around; but a filter that is led by luminance could only leave such pixels standing. (As the spatial outlier
/// rejection of real-time denoisers, after Zwicker et al. 2015, "Recent Advances in Adaptive Sampling and Reconstruction for Monte Carlo Rendering", with the test of significance
/// added.) O(pixels); in parallel in the caller's arena.
void limit_fireflies(std::span<MeasuredNoise> measured, const Guides& guides, Illumination& light);

}  // namespace grove
