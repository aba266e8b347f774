#pragma once

#include <vector>

#include "grove/lab/ray_set.h"
#include "grove/lab/workload.h"

namespace grove {

/// The rays that a path-traced picture of the scene shoots: "recorded", all of them, and "recorded-0", "recorded-1" and so on, those of each bounce: 0
/// are camera rays, n leave the n-th surface, towards a light or on the path. The picture has the scene's aspect, one sample a pixel, and as many pixels as
/// make about `ray_count` rays; where they are more, an even sample of them is taken, so "recorded" has at most `ray_count` and the bounces share these.
/// Paths end after 8 surfaces or by chance, as those of `grove render` do. The same rays for any structure and number of threads.
[[nodiscard]] std::vector<RaySet> recorded_rays(const Scene& scene, const SceneAccelerator& accelerator, const Camera& camera,
                                                const WorkloadSettings& settings);

}  // namespace grove
