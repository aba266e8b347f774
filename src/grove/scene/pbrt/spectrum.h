#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "grove/math/vector.h"
#include "grove/scene/pbrt/context.h"
#include "grove/scene/pbrt/parameters.h"

namespace grove::pbrt {

/// What a colour stands for, which decides how a spectrum becomes RGB.
enum class SpectrumUse : std::uint8_t {
  albedo,     ///< in [0, 1]; a constant spectrum is grey
  unbounded,  ///< indices of refraction, absorption: at least 0; a constant spectrum is grey
  illuminant  ///< emitted light: a spectrum or a black body is scaled to luminance 1, rgb stays as it is
};

/// The parameter `name` as linear RGB (Rec. 709): rgb, blackbody (kelvin), or a spectrum by name, by file, or as wavelengths in
/// nanometres with values. Nothing when there is no such parameter. Throws InputError for an unknown name and for numbers that are not finite.
[[nodiscard]] std::optional<Vec3> colour(const ParameterList& parameters, std::string_view name, SpectrumUse use, const Context& context);

/// The same for what our materials hold as one number (the index of refraction of glass): a float, or a spectrum at 587.6 nm (the line
/// that catalogues of glass quote).
[[nodiscard]] std::optional<float> spectral_number(const ParameterList& parameters, std::string_view name, const Context& context);

/// RGB of a spectrum that is linear between the given (wavelength, value) pairs and constant beyond; wavelengths ascend.
[[nodiscard]] Vec3 spectrum_to_rgb(std::span<const float> wavelengths_and_values, SpectrumUse use);

/// RGB, with luminance 1, of a black body; black for a temperature that is not positive.
[[nodiscard]] Vec3 blackbody_to_rgb(float kelvin);

}  // namespace grove::pbrt
