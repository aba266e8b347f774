#pragma once

#include "grove/math/vector.h"
#include "grove/scene/image.h"

namespace grove::pbrt {

/// The unit direction (z up) of a point of [0, 1]^2 under the equal-area octahedral map of Clarberg 2008, "Fast Equal-Area Mapping of the
/// (Hemi)Sphere using SIMD", as pbrt-v4 uses it for environments: z > 0 inside the diamond, which touches the middles of the sides.
[[nodiscard]] Vec3 octahedral_direction(const Vec2& uv);

/// An image in latitude and longitude (u = azimuth / 2 pi from +x toward +y, v = polar angle / pi from +z; pbrt-v3) resampled to a square
/// equal-area octahedral one with about as many pixels.
[[nodiscard]] Image equirectangular_to_octahedral(const Image& source);

/// RGB floats, 8-bit values decoded from sRGB.
[[nodiscard]] Image to_linear_floats(const Image& source);

/// Luminance that a patch facing +z receives from an octahedral image of radiance (floats).
[[nodiscard]] float upper_illuminance(const Image& image);

}  // namespace grove::pbrt
