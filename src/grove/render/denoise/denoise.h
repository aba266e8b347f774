#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "grove/render/denoise/a_trous.h"
#include "grove/render/image/colour_image.h"
#include "grove/render/render.h"

namespace grove {

/// What is done against noise when a picture is finished.
enum class Denoise : std::uint8_t {
  off,
  spatial,  ///< each picture for itself; see `denoise`
  temporal  ///< with what earlier frames found out; see denoise/temporal.h
};

/// The names, in the order of the enumeration.
[[nodiscard]] std::span<const std::string_view> denoise_names();
/// Throws UsageError that lists the names.
[[nodiscard]] Denoise denoise_from_name(std::string_view name);

/// A path-traced picture with less noise: what the first surface emits is put aside, what it reflects divided by its albedo, filtered as a_trous.h tells by how unsure it is, and put
/// together again. Where samples
/// leave no doubt, nothing is filtered: with more and more samples the result tends to the means of the film. `result` must hold first hits and moments
/// (`GatheringSettings`); pixels that show no surface stay as they are. Biased, as all such filters: shadows and reflections that no guide tells of may blur. O(pixels); about 250 bytes
/// of memory a pixel while it works; in parallel in the caller's arena, with the same result for any number of threads.
[[nodiscard]] ColourImage denoise(const RenderResult& result, const FilterSettings& settings = {});

}  // namespace grove
