#pragma once

#include <optional>
#include <string_view>

#include "grove/math/vector.h"

namespace grove::pbrt {

/// The measured spectra that pbrt-v4 has by name, "metal-Cu-eta", "glass-BK7", "stdillum-D65" and so on, as linear RGB: for metals the values
/// at the dominant wavelengths of the Rec. 709 primaries (611.4, 549.1 and 464.2 nm), for glasses that at 587.6 nm, for illuminants
/// their colour with luminance 1. Nothing for a name that is not known.
[[nodiscard]] std::optional<Vec3> named_spectrum(std::string_view name);

/// Linear RGB with luminance 1 of a CIE 1931 chromaticity; negative channels become 0.
[[nodiscard]] Vec3 chromaticity_to_rgb(float x, float y);

/// XYZ to linear RGB with the primaries and white (D65) of Rec. 709.
[[nodiscard]] Vec3 xyz_to_rgb(const Vec3& xyz);

}  // namespace grove::pbrt
