#pragma once

#include "grove/render/surface/surface_coordinates.h"
#include "grove/scene/scene.h"

namespace grove {

/// The part of light, in [0, 1], that meets the surface; the rest passes as though nothing were there. Interfaces are 0 unless they
/// emit, masks 0 or 1; of a mix the mean.
[[nodiscard]] float opacity(const Scene& scene, const Material& material, const SurfaceCoordinates& place);

/// Whether `opacity` can be below 1 anywhere.
[[nodiscard]] bool can_pass_light(const Scene& scene, const Material& material);

}  // namespace grove
