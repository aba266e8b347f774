#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "grove/math/vector.h"

namespace grove {

/// How linear scene light becomes linear display light in [0, 1]. The curves keep middle grey in place: colours are scaled before them so that 0.18
/// gives 0.18. Highlights too bright for their colour go to white.
enum class ToneMap : std::uint8_t {
  none,    ///< straight, cut at white
  filmic,  ///< Hable 2010, "Uncharted 2: HDR Lighting": the toe and shoulder of film, white at 11.2; softer, and greyer in the highlights
  aces     ///< Narkowicz 2015, "ACES Filmic Tone Mapping Curve": a rational fit to the ACES reference transform
};

/// The names of the curves, in the order of the enumeration.
[[nodiscard]] std::span<const std::string_view> tone_map_names();
/// Throws UsageError that lists the names.
[[nodiscard]] ToneMap tone_map_from_name(std::string_view name);

/// A colour through a curve. What is not a number becomes black.
[[nodiscard]] Vec3 tone_map(ToneMap curve, const Vec3& colour);

/// Linear in [0, 1] to sRGB-encoded in [0, 1] (IEC 61966-2-1). Values outside are clamped; NaN gives 0.
[[nodiscard]] float encode_srgb(float linear);

/// The other way.
[[nodiscard]] float decode_srgb(float encoded);

}  // namespace grove
