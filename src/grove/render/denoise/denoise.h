#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "grove/render/denoise/a_trous.h"
#include "grove/render/denoise/brightness.h"
#include "grove/render/denoise/guides.h"
#include "grove/render/denoise/illumination.h"
#include "grove/render/denoise/noise_estimate.h"
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

/// What a filter works on: a picture taken apart. What the first surface emits is put aside, and what it reflects is divided by its albedo.
struct TakenApart {
  Guides guides;
  Illumination light;  ///< as sampled; its variance is still to be estimated
  std::vector<MeasuredNoise> noise;
  std::vector<Vec3> emitted;
};

/// Takes a path-traced picture apart. `result` must hold first hits (`GatheringSettings`). O(pixels); in parallel in the caller's arena.
[[nodiscard]] TakenApart take_apart(const RenderResult& result);

/// Light with less noise: fireflies limited (fireflies.h), its noise estimated from what was measured (noise_estimate.h), filtered (a_trous.h), and made as bright again as the samples bear
/// out (brightness.h): those of `evidence`, whose variances are filled in from `noise`. O(pixels); in parallel in the caller's arena.
[[nodiscard]] Illumination filter_light(Illumination light, std::vector<MeasuredNoise> noise, const Guides& guides,
                                        const FilterSettings& settings, BrightnessEvidence evidence);

/// A path-traced picture with less noise: taken apart, filtered as `filter_light` tells by how unsure it is, and put together again. Where samples leave no doubt, nothing is filtered: with more
/// and more samples the result tends to the means of the film. Pixels that show no surface stay as they are. Biased, as all such filters: shadows and reflections that no guide tells of
/// may blur. `result` as for `take_apart`. O(pixels); about 270 bytes of memory a pixel while it works; in parallel in the caller's arena, with the same result for any number
/// of threads.
[[nodiscard]] ColourImage denoise(const RenderResult& result, const FilterSettings& settings = {});

}  // namespace grove
