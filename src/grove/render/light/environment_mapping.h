#pragma once

#include "grove/math/vector.h"
#include "grove/scene/light.h"

namespace grove {

/// Where a direction (unit length, environment space) lies on the picture of an environment: (u, v) in [0, 1]^2 with (0, 0) the corner of
/// the first pixel.
///
/// Equirectangular: v runs from +y down to -y, u from +z through -x, -z (the middle of the picture) and +x around to +z again: what one
/// sees when looking along -z with +x to the right.
/// Octahedral: equal areas (Clarberg 2008, "Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD"); +z in the middle, -z at the
/// corners, u along x and v along y.
[[nodiscard]] Vec2 environment_uv(EnvironmentMapping mapping, const Vec3& direction);

/// The inverse: a unit direction.
[[nodiscard]] Vec3 environment_direction(EnvironmentMapping mapping, const Vec2& uv);

/// Area on the picture (of 1 in all) per solid angle at `direction`; infinite at the poles of the equirectangular mapping.
[[nodiscard]] float environment_area_per_solid_angle(EnvironmentMapping mapping, const Vec3& direction);

}  // namespace grove
