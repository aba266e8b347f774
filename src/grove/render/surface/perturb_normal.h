#pragma once

#include "grove/render/surface/surface_point.h"
#include "grove/scene/scene.h"

namespace grove {

/// The shading normal after the material's normal map and bump map, on the outer side, of unit length.
[[nodiscard]] Vec3 perturbed_normal(const Scene& scene, const Material& material, const SurfacePoint& point);

/// The normal of the material's clear coat: with the coat's own normal map, and without the surface's.
[[nodiscard]] Vec3 coat_normal(const Scene& scene, const Material& material, const SurfacePoint& point);

}  // namespace grove
